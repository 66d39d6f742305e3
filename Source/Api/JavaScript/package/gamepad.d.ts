// SPDX-License-Identifier: MIT
import type { HapticEvent, Nanoseconds, PadProfile, PhysVib } from 'physvib';
import type { Haptics } from './attach.js';

export interface RumbleOptions {
    /** 'pad-generic', 'pad-xbox', 'pad-dualshock', or a profile ('pad-generic'). */
    profile?: string | PadProfile;
    fieldWidth?: number;
    fieldHeight?: number;
    /** From a collision to its vibration, s. Left out: what the first second of the game wants. */
    latency?: number;
    /** (1) */
    level?: number;
    /** false: leaves a phone's own motor alone (true). */
    phone?: boolean;
}

export interface Pads {
    readonly commands: number;
    readonly refused: number;
    /** Events for which there was no room. */
    readonly lost: number;
    follow(haptics: Haptics): () => void;
    strike(events: readonly HapticEvent[], laterNs?: Nanoseconds): void;
    setLevel(level: number): void;
    stop(): void;
    close(): void;
}

/** Every controller that the browser has, as it comes and goes: its motors, or samples where it has playPCM (a draft). */
export function rumble(physvib: PhysVib, options?: RumbleOptions): Pads;
