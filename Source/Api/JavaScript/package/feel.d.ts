// SPDX-License-Identifier: MIT
import type { HapticValues, Layout, LayoutName, PhysVib } from 'physvib';
import type { AttachOptions, SteppedHaptics } from './attach.js';
import type { Output } from './audio.js';
import type { Pads } from './gamepad.js';
import type { VelocityEngine } from './velocities.js';

export interface MatterEngine { world: object; pairs: object; timing: object }
export interface PlanckWorld { getBodyList(): any; on(...of: any[]): any }
export interface RapierWorld { bodies: object; colliders: object; narrowPhase: object; gravity: object }

export interface FeelOptions extends AttachOptions {
    /** What load() gave; left out: load() is called. */
    physvib?: PhysVib;
    /** Of the engine's lengths; 1 / metresPerUnit. */
    pixelsPerMetre?: number;
    layout?: LayoutName | Layout;
    /** Device outputs of the actuators, from 1. */
    outputs?: readonly number[];
    /** 0 to 1 (0.25). */
    level?: number;
    /** The same hits for ears, too, left and right by their place: on two outputs (those behind the actuators'), at a level of 0 to 1 (0.1). */
    sound?: true | { outputs?: readonly [number, number]; level?: number };
    /** s */
    latency?: number;
    worklet?: string | URL;
    /** An AudioContext of yours; left out: one is made at the first click or key. */
    context?: AudioContext;
    /** Of controllers ('pad-generic'). */
    profile?: string;
    /** false: leaves a phone's own motor alone (true). */
    phone?: boolean;
    /** box2d3-wasm's module, where the engine is a b2WorldId. */
    b2?: object;
    yDown?: boolean;
}
export interface Felt<Body = any> {
    readonly physvib: PhysVib;
    readonly haptics: SteppedHaptics<Body>;
    /** From the first gesture on; null before, and without audio. */
    readonly output: Output | null;
    /** null: not asked for, or the device has no outputs for it (then the monitor is what is heard). */
    readonly sound: Output | null;
    readonly pads: Pads | null;
    readonly error: Error | null;
    /** A material's name makes the body a source of it. */
    set(body: Body, values?: string | (HapticValues & { material?: string })): number;
    /** Steps the engine, where it does not step itself. */
    update(seconds: number): void;
    explain(): string;
    close(): void;
}

/** Attaches to an engine (fullScaleImpulse: 'automatic'), and plays on what the page has: its audio device from the first click or key on, controllers, a phone's motor. */
export function feel<Body = any>(engine: MatterEngine | PlanckWorld | RapierWorld | VelocityEngine<Body> | object, options?: FeelOptions): Promise<Felt<Body>>;
