// SPDX-License-Identifier: MIT
import type { HapticEvent, Impact, Nanoseconds, PhysVib, RendererSettings, RendererStatus } from 'physvib';
import type { Haptics } from './attach.js';

export interface AudioOptions extends RendererSettings {
    /** From a collision to its vibration, s: more than a step of the game and its longest stutter. Left out: what the first second of the game wants, as little as 0.03. */
    latency?: number;
    /** 0 to 1: full scale (0.25). */
    level?: number;
    /** Where worklet.js is, for bundlers that move it. */
    worklet?: string | URL;
    /** The device output of each actuator, from 1 (in order: 1, 2, 3 ...). */
    outputs?: readonly number[];
}

/** 'late' for a second after events came after their time. */
export type OutputState = 'running' | 'suspended' | 'device lost' | 'late';
export interface StateEvent extends Event { readonly state: OutputState }

/** What left for the device at one actuator. */
export interface Receipt {
    /** That a device took. */
    frames: number;
    /** Of full scale, behind level, gains and mutes. */
    peak: number;
    meanSquare: number;
    /** Whether a device took every frame between the two times. */
    running: boolean;
}

export interface Output {
    readonly channels: number;
    /** Whether each actuator has an output of its own, as it is connected now; else one hears a stereo monitor. */
    readonly isDirect: boolean;
    readonly state: OutputState;
    onstate: ((event: StateEvent) => void) | null;
    addEventListener(type: 'state', listener: (event: StateEvent) => void): void;
    removeEventListener(type: 'state', listener: (event: StateEvent) => void): void;
    /** Whether it runs within a second, on another device where its own is gone. To be called in a click. */
    resume(): Promise<boolean>;
    /** What left for the device between two times of the context (s; context.outputLatency later it is there): one for each actuator, in whole blocks of 128 frames.
     * It is told within 0.1 s, and kept for 20. */
    left(from: number, to: number): Receipt[];
    /** Which is which: 0.3 s of 200 Hz at one actuator, at half of full scale times the level; resolves when it is over. */
    buzz(actuator: number): Promise<void>;
    /** Hits that were meant for a time at which the context stood still: they are over. */
    readonly dropped: number;
    /** Of several worlds that follow, the longest. */
    readonly latency: number;
    /** Frames that the browser left out while its audio thread stood still. */
    readonly skipped: number;
    /** What ended the audio thread, told once on the console; null: nothing did. Close the output, and play anew. */
    readonly error: Error | null;
    /** How often a game stood still for longer than the latency, or changed its pace, and was aligned anew. */
    readonly moves: number;
    /** Of the audio thread, four times a second: `late` counts events that came after their time. */
    readonly status: RendererStatus;
    readonly node: AudioWorkletNode;
    readonly context: AudioContext;
    readonly physvib: PhysVib;
    readonly settings: RendererSettings;
    /** Frames by which samples lag the events' times: the limiter's look-ahead. */
    readonly latencyFrames: number;
    /** Samples of yours, a channel per actuator, at the context's rate, from that time of the context (s) on; without one now, as what is struck. */
    playSamples(channels: readonly Float32Array[], seconds?: number): AudioBufferSourceNode;
    follow(haptics: Haptics): () => void;
    /** `laterNs`: from the times of the events to the context's; left out: now. */
    strike(events: readonly HapticEvent[], laterNs?: Nanoseconds): void;
    /** Resolves when what was struck so far is on the audio thread: wait for it before an OfflineAudioContext renders, which may be faster than messages. */
    arrived(): Promise<void>;
    /** One impact now. */
    impact(hit?: Impact): void;
    /** 0 to 10000. */
    setGain(channel: number, gain: number): void;
    setMute(channel: number, isMuted: boolean): void;
    setLevel(gain: number): void;
    /** As many actuators as it has. */
    setLayout(settings: RendererSettings): void;
    silence(): void;
    close(): void;
}

/** `context`: made or resumed by a click. Rejects where a page has no AudioWorklet: over http, but for localhost. */
export function play(physvib: PhysVib, context: AudioContext, options?: AudioOptions): Promise<Output>;
