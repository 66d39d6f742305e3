// SPDX-License-Identifier: MIT
import type { PhysVib } from 'physvib';
import type { AttachOptions, SpaceHaptics } from './attach.js';

/** `engine`: what @mujoco/mujoco's module gives, a MjModel, a MjData. Bodies are ids, or names. update() is instead of mj_step, by the model's timestep; all integrators but RK4.
 * `restitution`: of all contacts (what their solref gives back). */
export function attach(physvib: PhysVib, engine: { mujoco: object; model: object; data: object }, options?: AttachOptions & { restitution?: number }): SpaceHaptics<number | string>;
