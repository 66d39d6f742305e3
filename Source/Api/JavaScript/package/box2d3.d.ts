// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, Haptics } from './attach.js';

/** `world`: a b2WorldId; `b2`: the module of box2d3-wasm. */
export function attach<Body = any>(physvib: PhysVib, world: object, options: AttachOptions & { b2: object; restitutionThreshold?: number }): Haptics<Body>;
