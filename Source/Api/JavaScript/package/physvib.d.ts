// SPDX-License-Identifier: MIT
/** A number of SI units unless its name says another. Times are whole nanoseconds, exact for 104 days. */
export type Nanoseconds = number;

/** What was wrong, in one line; `code` is one of PHYSVIB_ERROR_... of physvib.h. */
export class PhysVibError extends Error {
    readonly code: number;
    constructor(code: number, line: string);
}

/** A collision as it is felt: amplitude * sin(2 pi frequencyHz t) * exp(-decayPerSecond t), t counted from timeNs. */
export interface HapticEvent {
    timeNs: Nanoseconds;
    /** 0: until it has decayed. */
    durationNs?: Nanoseconds;
    frequencyHz: number;
    decayPerSecond: number;
    /** 1: full scale of an actuator. */
    amplitude: number;
    /** In the field, from its lower left corner. */
    x: number;
    y: number;
    /** That it came from, N s; 0: unknown. */
    impulse?: number;
    /** Of the body that feels; 0: unknown. */
    massKg?: number;
    /** Number of the body that feels; -1: unknown. */
    fixture?: number;
    /** Number of what struck it; -1: unknown. */
    other?: number;
    kind?: 'hit' | 'roll' | 'slide';
    /** Number of its sound's name; 0: none. A list of events gives it that of a material. */
    sound?: number;
    /** Place across the plane of x and y, m (0). */
    z?: number;
    /** The part of a body on whose actuators it is felt: a name such as 'thumb', or its number; 0: on all. */
    part?: string | number;
}
export type FullHapticEvent = Required<HapticEvent>;

/** Where the actuators sit, from the lower left corner of the extent, onto which the field is mapped. */
export interface Layout {
    extentWidth: number;
    extentHeight: number;
    places: { x: number; y: number; z?: number; part?: string | number }[];
}

/** Of a preset, or (string) of another one. */
export type LayoutName = 'phone1' | 'phone2' | 'phone3' | 'phone4' | 'ring1' | 'ring2' | 'ring3' | 'ring4' | 'cabinet4' | 'pico4' | 'pico8' | (string & {});

export interface RendererSettings {
    /** 5,000 to 192,000 Hz (48,000). */
    rate?: number;
    /** 0: as many as the layout has actuators (0). */
    channels?: number;
    law?: 'auto' | 'linear' | 'log' | 'log-outer' | 'energy' | 'neighbours' | 'distance' | 'triangles' | (string & {});
    /** false: samples may exceed 1 (true). */
    limiter?: boolean;
    exponent?: number;
    /** That x and y span; 0: the layout's extent (0). */
    fieldWidth?: number;
    fieldHeight?: number;
    /** A preset's name, or a layout ('phone4'). */
    layout?: LayoutName | Layout;
}

export interface RendererStatus { liveModes: number; pending: number; frames: number; played: number; late: number; rejected: number; refused: number }

export interface WorldSettings {
    isMuted?: boolean;
    /** At most so many hits become events in a step, the strongest; -1: all (-1). */
    hitsPerStep?: number;
    /** A hit is felt at the body's centre, and not at the point of contact (false). */
    atBody?: boolean;
    dropsHitsOfRemoved?: boolean;
    /** Of the rectangle that is felt (1); its height is what outputs take (as wide). */
    fieldWidth?: number;
    fieldHeight?: number;
    /** Its lower left corner in the world. */
    fieldX?: number;
    fieldY?: number;
    /** How it is turned, radians. */
    fieldAngle?: number;
    /** Of Eq. 5.4, s/m; null: by the field's width (null). */
    normalisation?: number | null;
    handMassKg?: number | null;
    driveGain?: number;
    /** A hit changes the velocity of the lighter body by as much, m/s (0.15). */
    threshold?: number;
    /** The impulse of amplitude 1, N s, whatever masses say; 'automatic': learned from the hits; 0: by masses (0). */
    fullScaleImpulse?: number | 'automatic';
    /** Hits before this time of the world are not felt, s (0). */
    settling?: number;
}

/** How a body feels and sounds. */
export interface HapticValues {
    /** Its collisions are felt: it is a haptic source (false). */
    isSource?: boolean;
    voice?: 'own' | 'other' | 'both';
    /** Its kind, above 0, for pair(). */
    surface?: number;
    /** At which it vibrates; 0: not at all (0). */
    frequencyHz?: number;
    decayPerSecond?: number;
    /** For a source that nothing moves. */
    staticMassKg?: number;
    gain?: number;
    handMassKg?: number | null;
    /** Further modes, at most three. */
    overtoneHz?: number[];
    overtoneDecayPerSecond?: number[];
    overtoneAmplitude?: number[];
    /** What rolls or slides along it passes a grain every so many metres (0: smooth, silent). */
    grain?: number;
    roughness?: number;
    rolling?: number;
    isRidged?: boolean;
    /** For your own routing, see deviceOf. */
    device?: number;
    /** Number of the part of a body on whose actuators it is felt; 0: on all, by place (0). */
    part?: number;
}
export interface BodyValues extends HapticValues {
    /** 0: what strikes it does not move it (0). */
    massKg?: number;
    inertia?: number;
    gravityScale?: number;
}

/** x, y and z. */
export type Vector = ArrayLike<number>;

/** Two bodies touch: tell the impulse, or how fast they near each other, or neither if move() tells the motions. */
export interface Contact {
    x?: number;
    y?: number;
    /** Of length 1, from a to b (0, 1). */
    normalX?: number;
    normalY?: number;
    /** Along the normal, in this step, N s; null: not told (null). */
    impulse?: number | null;
    tangential?: number;
    /** Before the engine's solver, m/s. */
    approach?: number | null;
    restitution?: number;
    effectiveMassKg?: number | null;
    /** When they touched, in steps after this one's start. */
    fraction?: number | null;
    /** Between the surfaces when the engine looked; below 0: they overlap. */
    gap?: number;
    /** When that was, in steps after this one's start: 0 or 1. */
    gapFraction?: number;
    alongA?: number | null;
    alongB?: number | null;
    /** The impulse of one step is no measure of an impact; 'whole': but it is all that the bodies were given in that step. */
    isSoft?: boolean | 'whole';
    /** Which point of its pair it is: a number, or told apart by place. */
    point?: number | 'none' | 'place';
    isImpulseOfPair?: boolean;
    /** In space: across the plane of the field. */
    z?: number;
    normalZ?: number;
    /** In space: impulse on b across the normal, N s, instead of tangential. */
    frictionX?: number;
    frictionY?: number;
    frictionZ?: number;
}

export interface WorldCounts { contacts: number; belowThreshold: number; noSource: number; unplayable: number; muted: number; dropped: number; events: number; threshold: number }

/** What is known of an output that plays a world's events. */
export interface OutputFacts {
    /** No device asks for samples. */
    isMissing?: boolean;
    isSilent?: boolean;
    /** That the device has; 0: as many as the layout has actuators (0). */
    channels?: number;
    /** Gain of all channels (1). */
    level?: number;
    /** Bit j: channel j is muted. */
    mutedChannels?: number;
    late?: number;
    dropped?: number;
    rejected?: number;
    withoutPart?: number;
    /** Layout and field. */
    settings?: RendererSettings;
}

/** Contacts of any engine in, events out. Bodies are numbers of yours, from 0 on. */
export interface World {
    readonly fieldWidth: number;
    readonly fieldHeight: number;
    configure(settings: WorldSettings): void;
    setBody(body: number, values?: BodyValues): void;
    /** The mass that the engine gives a body now, 0: it does not move; its inertia changes by as much. */
    setMass(body: number, massKg: number): void;
    removeBody(body: number): void;
    /** `device` of a body, also after it was removed. */
    deviceOf(body: number): number;
    /** Centre of mass, velocity and spin before the engine's solver. */
    move(body: number, x: number, y: number, vx: number, vy: number, spin?: number): void;
    /** Velocity and spin behind it, for engines that do not tell impulses. */
    moved(body: number, vx: number, vy: number, spin?: number): void;
    /** move in space. `inverseInertia`: of its moments of inertia as it is turned now, in the world's axes (xx, yy, zz, xy, xz, yz); null: `inertia` about every axis. */
    moveInSpace(body: number, centre: Vector, velocity: Vector, spin?: Vector, inverseInertia?: ArrayLike<number> | null): void;
    /** moved in space. */
    movedInSpace(body: number, velocity: Vector, spin?: Vector): void;
    pair(surface: number, other: number, sound: { frequencyHz: number; decayPerSecond: number; gain?: number }): void;
    /** A step: `contacts` calls touch for every pair that touches. */
    step(seconds: number, gravity: number, contacts?: () => void): void;
    beginStep(seconds: number, gravity?: number): void;
    endStep(): void;
    touch(a: number, b: number, contact?: Contact): void;
    begin(a: number, b: number, contact?: Contact): void;
    push(a: number, b: number, contact?: Contact): void;
    end(a: number, b: number): void;
    readonly timeNs: Nanoseconds;
    /** Events that are final (a step later, in order); all of them, `atOnce`. */
    take(atOnce?: boolean): FullHapticEvent[];
    /** The same into a renderer, `laterNs` after they happened. How many. */
    send(renderer: Renderer, laterNs?: Nanoseconds, atOnce?: boolean): number;
    readonly drops: number;
    readonly thinned: number;
    readonly counts: WorldCounts;
    /** Why nothing, or not everything, is felt of what happened since the last call: one sentence. `output`: what plays the events. */
    explain(output?: Renderer | OutputFacts): string;
    /** What the engine says of a body now; call it before explain, which forgets it. */
    note(body: number, note: 'sensor' | 'filtered' | 'disabled' | 'asleep'): void;
    free(): void;
}

/** One impact, without a world. */
export interface Impact {
    /** In the field, from its lower left corner (0). */
    x?: number;
    y?: number;
    /** 0 to 1 of full scale (0.5). */
    strength?: number;
    /** A built-in one; left out: a vibration of 200 Hz and a decay of 30 per second. */
    material?: string;
}
/** The names of the built-in materials that vibrate. */
export const materials: readonly string[];
/** How a body of a built-in material vibrates: values of setBody. */
export function material(name: string): HapticValues;

/** Events in, samples out. Time 0 is its first frame. */
export interface Renderer {
    readonly channels: number;
    readonly rate: number;
    strike(event: HapticEvent): void;
    /** One impact at the next pull. */
    impact(hit?: Impact): void;
    pull(frames: number): Float32Array[];
    pull<Arrays extends Float32Array[]>(into: Arrays): Arrays;
    setGain(timeNs: Nanoseconds, channel: number, gain: number): void;
    setMute(timeNs: Nanoseconds, channel: number, isMuted: boolean): void;
    setLevel(timeNs: Nanoseconds, gain: number): void;
    setLayout(timeNs: Nanoseconds, settings: RendererSettings): void;
    silence(timeNs: Nanoseconds, untilNs: Nanoseconds): void;
    readonly latencyFrames: number;
    readonly status: RendererStatus;
    free(): void;
}

/** What motors of a controller do: a profile of Docs/pads.md. */
export interface PadProfile {
    commands_per_s: number; lead_s: number; split_hz: number; side: number; floor: number; exponent: number;
    low: PadMotor; high: PadMotor;
}
export interface PadMotor { threshold: number; half: number; full: number; rise_s: number; fall_s: number }

export interface Pad {
    strike(event: HapticEvent): void;
    readonly dueNs: Nanoseconds;
    next(level?: number): { timeNs: Nanoseconds; low: number; high: number };
    stop(atNs: Nanoseconds): void;
    readonly lost: number;
    readonly commandsPerSecond: number;
    free(): void;
}

export interface Clip {
    rate: number;
    channels: Float32Array[];
    places: ({ x: number; y: number } | null)[];
    extentWidth: number;
    extentHeight: number;
    /** What the file holds and is not played, one line; or ''. */
    leftOut: string;
}

export type Bytes = ArrayBuffer | ArrayBufferView;
export type Source = string | URL | Bytes | WebAssembly.Module | Response | Promise<Response>;

export class PhysVib {
    constructor(compiled: WebAssembly.Module, files?: Source, worklet?: string);
    /** For workers: new PhysVib(module). */
    readonly module: WebAssembly.Module;
    readonly version: string;
    /** Names of the laws of panning. */
    readonly laws: string[];
    readonly memoryBytes: number;
    /** The text of worklet.js; undefined: it is a file. */
    readonly worklet: string | undefined;
    world(settings?: WorldSettings): World;
    renderer(settings?: RendererSettings): Renderer;
    pad(profile?: string | PadProfile, settings?: { fieldWidth?: number; fieldHeight?: number }): Pad;
    /** Events, in the order of their times, to samples: an array per channel. */
    render(events: readonly HapticEvent[], settings: RendererSettings & { seconds: number }): Float32Array[];
    /** What each actuator gets of a hit at a place of the field. */
    gains(x: number, y: number, settings?: RendererSettings): number[];
    layout(name: string): Layout;
    /** L: see Docs/timings.md. */
    playOutNs(rate: number, blockFrames: number, stepsPerSecond: number, longestGapSeconds?: number): Nanoseconds;
    parseLayout(text: string): Promise<Layout>;
    /** With the field that the list says, if it does; render() takes it where its settings say none. */
    parseEvents(text: string): Promise<FullHapticEvent[] & { fieldWidth?: number; fieldHeight?: number }>;
    /** `field`: what their places span, m; left out, that of parseEvents. */
    eventsText(events: readonly HapticEvent[], field?: { fieldWidth?: number; fieldHeight?: number }): Promise<string>;
    /** A WAVE file of 32-bit floats. */
    wav(channels: readonly Float32Array[], rate?: number): Promise<Uint8Array>;
    /** A haptic file, of a format that `physvib export` writes, to samples. */
    readClip(data: string | ArrayBuffer | Uint8Array, name: string, settings?: { rate?: number }): Promise<Clip>;
    /** Events as such a file; formats with one channel give a file for each actuator that plays. */
    writeClip(events: readonly HapticEvent[], name: string, settings?: RendererSettings & { error?: number }): Promise<{ name: string; bytes: Uint8Array }[]>;
}

/** `source`: physvib.wasm, if it is not beside the package's files (an address relative to the page, in Node to the working folder); `files`: the same of files.wasm; `worklet`: the text of worklet.js. Rejects with the address and
 * the server's status. */
export function load(source?: Source, options?: { files?: Source; worklet?: string }): Promise<PhysVib>;
