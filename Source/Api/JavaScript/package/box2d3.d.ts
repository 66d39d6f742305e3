// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, SteppedHaptics } from './attach.js';

/** `world`: a b2WorldId; `b2`: the module of box2d3-wasm; `subSteps`: of a step (4). */
export function attach<Body = any>(physvib: PhysVib, world: object, options: AttachOptions & { b2: object; restitutionThreshold?: number; subSteps?: number }): SteppedHaptics<Body>;
