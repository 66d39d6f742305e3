// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, SteppedHaptics } from './attach.js';

/** The package @babylonjs/havok without Babylon; bodies are HP_BodyIds. */
export interface HavokWorld {
    /** What HavokPhysics() gives. */
    havok: object;
    /** A HP_WorldId. */
    world: object;
    /** All in the world, as HP_Body_Create gave them: it has no list of its own. */
    bodies(): Iterable<[bigint]>;
    /** As HP_World_SetGravity has it ([0, -9.81, 0]). */
    gravity?: readonly number[] | (() => readonly number[]);
}

/** `engine`: Babylon's scene with HavokPlugin (bodies: a PhysicsBody, a mesh, an aggregate), or the package itself. Who steps it, steps it still. */
export function attach<Body = any>(physvib: PhysVib, engine: HavokWorld | object, options?: AttachOptions): SteppedHaptics<Body>;
