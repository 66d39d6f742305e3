// SPDX-License-Identifier: MIT
import type { HapticEvent, Impact, Nanoseconds, PhysVib, RendererSettings, RendererStatus } from 'physvib';
import type { Haptics } from './attach.js';

export interface AudioOptions extends RendererSettings {
    /** From a collision to its vibration, s: more than two steps of the game and its longest stutter. Left out: 0.06, or what the first second of the game wants. */
    latency?: number;
    /** 0 to 1: full scale (0.25). */
    level?: number;
    /** Where worklet.js is, for bundlers that move it. */
    worklet?: string | URL;
}

export interface Output {
    readonly channels: number;
    /** Whether each actuator has an output of its own; else one hears a stereo monitor. */
    readonly isDirect: boolean;
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
    /** Samples of yours, a channel per actuator, at the context's rate, from that time of the context (s) on. */
    playSamples(channels: readonly Float32Array[], seconds?: number): AudioBufferSourceNode;
    follow(haptics: Haptics): () => void;
    strike(events: readonly HapticEvent[], laterNs?: Nanoseconds): void;
    /** Resolves when what was struck so far is on the audio thread: wait for it before an OfflineAudioContext renders, which may be faster than messages. */
    arrived(): Promise<void>;
    /** One impact now. */
    impact(hit?: Impact): void;
    setGain(channel: number, gain: number): void;
    setMute(channel: number, isMuted: boolean): void;
    setLevel(gain: number): void;
    setLayout(settings: RendererSettings): void;
    silence(): void;
    close(): void;
}

/** `context`: made or resumed by a click. Rejects where a page has no AudioWorklet: over http, but for localhost. */
export function play(physvib: PhysVib, context: AudioContext, options?: AudioOptions): Promise<Output>;
