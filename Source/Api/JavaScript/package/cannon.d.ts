// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, SteppedHaptics } from './attach.js';

/** `world`: cannon-es' World; who steps it, steps it still; update() is its step(). */
export function attach<Body = any>(physvib: PhysVib, world: object, options?: AttachOptions): SteppedHaptics<Body>;
