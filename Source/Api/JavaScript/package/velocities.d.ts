// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, Haptics } from './attach.js';

/** A body as the engine has it now, in its units. */
export interface BodyState {
    /** Its centre. */
    x: number;
    y: number;
    /** Per second. */
    vx: number;
    vy: number;
    /** Radians per second (0). */
    spin?: number;
    /** Of its box, which is not turned; or a circle's radius. */
    width?: number;
    height?: number;
    radius?: number;
    /** 0: nothing moves it (1). */
    massKg?: number;
    /** 0: it does not fall (1). */
    gravityScale?: number;
}

export interface VelocityEngine<Body = any> {
    /** All that may touch. */
    bodies(): Iterable<Body>;
    /** Writes a body's state to `to`. */
    read(body: Body, to: BodyState): void;
    /** In the engine's units per second squared (none). */
    gravity?: { x: number; y: number } | (() => { x: number; y: number });
    /** The walls of a rectangle that bodies stay in (none). */
    bounds?(): { x: number; y: number; width: number; height: number };
    /** The body of what set, id, remove and touch are given, a sprite say (the thing itself). */
    bodyOf?(thing: any): Body;
    /** Contacts are those that touch() names alone (false: boxes and circles that meet). */
    tells?: boolean;
}

export interface VelocityHaptics<Body = any> extends Haptics<Body> {
    /** Before a step: call it behind what the game itself does to velocities. Left out, the last update is what was before. */
    look(): void;
    /** The engine has made a step of so many seconds. */
    update(seconds: number): void;
    /** Two bodies have touched in this step, for an engine that `tells`; `normal`: of length 1, from a to b. */
    touch(a: Body, b: Body, contact?: { normal?: { x: number; y: number }; x?: number; y?: number }): void;
}

/** Options as for Matter: metresPerUnit is 0.01; `yDown`: the engine's y points down (true). */
export function attachVelocities<Body = any>(physvib: PhysVib, engine: VelocityEngine<Body>, options?: AttachOptions & { yDown?: boolean }): VelocityHaptics<Body>;
