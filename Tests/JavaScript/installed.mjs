// SPDX-License-Identifier: MIT
// Packages that npm has installed in a folder elsewhere.
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';

/** load(FOLDER, NAME): the package of that name in that folder. */
export async function load(folder, name) {
    const inside = createRequire(join(resolve(folder), 'index.js'));
    return import(pathToFileURL(inside.resolve(name)));
}
