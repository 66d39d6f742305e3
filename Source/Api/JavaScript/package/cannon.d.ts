// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, Haptics } from './attach.js';

/** `world`: cannon-es' World; it steps itself. */
export function attach<Body = any>(physvib: PhysVib, world: object, options?: AttachOptions): Haptics<Body>;
