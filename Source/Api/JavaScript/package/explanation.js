// SPDX-License-Identifier: MIT
// Explanations in the names that JavaScript has.
import { names } from './names.js';

/** What engines say of a body: PHYSVIB_NOTE_... */
export const notes = ['sensor', 'filtered', 'disabled', 'asleep'];

const members = new Map(Object.values(names).flatMap(Object.entries));
const camel = name => name.replace(/_(.)/g, (_, letter) => letter.toUpperCase());

/** An explanation with the names that JavaScript has: is_camera is isSource, physvib_world_set_body is setBody. */
export const inWords = sentence => sentence.replace('divide lengths by the pixels of a metre (100, say)', 'divide lengths by the pixels of a metre, or set metresPerUnit (0.01, say)')
    .replace(/(?<![\w/.])(physvib_[a-z]+_)?([a-z]+(?:_[a-z0-9]+)*)\b/g, (word, isCall, name) => (isCall ? camel(name) : name.includes('_') ? members.get(name) ?? camel(name) : word));
