// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, Haptics } from './attach.js';

/** `engine`: what Engine.create() gives, or Phaser's `this.matter.world.engine`; it steps itself. */
export function attach<Body = any>(physvib: PhysVib, engine: object, options?: AttachOptions): Haptics<Body>;
