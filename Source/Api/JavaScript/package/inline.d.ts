// SPDX-License-Identifier: MIT
import type { PhysVib, Source } from './physvib.js';
export * from './physvib.js';

/** The code is inside: nothing is fetched. `files`: as of physvib's load. */
export function load(options?: { files?: Source }): Promise<PhysVib>;
