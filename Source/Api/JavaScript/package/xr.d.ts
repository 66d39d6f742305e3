// SPDX-License-Identifier: MIT
import type { HapticEvent, Nanoseconds, PhysVib } from 'physvib';
import type { Haptics } from './attach.js';
import type { RumbleOptions } from './gamepad.js';

export type Hand = 'left' | 'right';
export interface Hands {
    /** What touches a body of `left` is felt on the left hand, of `right` on the right; without both, all on both. What it returns ends that. */
    follow<Body>(haptics: Haptics<Body>, of?: { left?: Body | Body[]; right?: Body | Body[] }): () => void;
    strike(hand: Hand, events: readonly HapticEvent[], laterNs?: Nanoseconds): void;
    /** 0 or more (1). */
    setLevel(level: number): void;
    stop(): void;
    close(): void;
}

/** Controllers of WebXR. `session`: an XRSession, or a function that gives the one of now: `() => renderer.xr.getSession()`. */
export function hands(physvib: PhysVib, session: object | (() => object | null | undefined), options?: Omit<RumbleOptions, 'phone'>): Hands;
