// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, SteppedHaptics } from './attach.js';

/** `engine`: what jolt-physics' module gives, and a JoltInterface; bodies are Jolt's Bodies or their BodyIDs. update() is its Step(seconds, 1); who calls Step itself, does so still. */
export function attach<Body = any>(physvib: PhysVib, engine: { Jolt: object; interface: object }, options?: AttachOptions): SteppedHaptics<Body>;
