// SPDX-License-Identifier: MIT
// Explanations and errors with JavaScript's names instead of those of C.
import { PhysVibError } from './module.js';
import { names } from './names.js';

/** Notes of an engine about a body, as PHYSVIB_NOTE_... */
export const notes = ['sensor', 'filtered', 'disabled', 'asleep'];

const members = new Map(Object.values(names).flatMap(Object.entries));
const camel = name => name.replace(/_(.)/g, (_, letter) => letter.toUpperCase());

/** An explanation with the names that JavaScript has: is_camera is isSource, physvib_world_set_body is setBody. */
export const inWords = sentence => sentence.replace('divide lengths by the pixels of a metre (100, say)', 'divide lengths by the pixels of a metre, or set metresPerUnit (0.01, say)')
    .replace(/(?<![\w/.])(physvib_[a-z]+_)?([a-z]+(?:_[a-z0-9]+)*)\b/g, (word, isCall, name) => (isCall ? camel(name) : name.includes('_') ? members.get(name) ?? camel(name) : word));

/** Returns make(); an error about an unknown name lists the names in `others` too. */
export function naming(others, make) {
    try { return make(); } catch (error) {
        if (error.message.includes(': expected one of ')) error.message += `, ${others}`;
        throw error;
    }
}

export const expectLibrary = (name, physvib) => expectThat(typeof physvib?.world === 'function', name, 'the library (await load())', physvib);
/** Throws for a wrong object, a promise of the right one, or a value that is no number. */
export function expectThat(isOne, name, expected, found) {
    if (!isOne) throw new PhysVibError(-2, `${name}: expected ${expected}, found ${found?.type ?? (Object(found) === found ? found.constructor?.name : found)}`);
}
