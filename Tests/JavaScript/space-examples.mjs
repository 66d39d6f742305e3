// SPDX-License-Identifier: MIT
// The examples of engines in space, as their reader runs them: space-examples.mjs FOLDER EXAMPLES. Each drops 0.2 kg by 0.8 m, with half of the speed given back.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { copyFileSync } from 'node:fs';
import { join } from 'node:path';
import test from 'node:test';

const [folder, examples] = process.argv.slice(2), due = 0.2 * Math.sqrt(2 * 9.81 * 0.8) * 1.5;
for (const name of ['cannon', 'babylon', 'jolt', 'mujoco']) test(name, () => {
    copyFileSync(join(examples, `${name}.mjs`), join(folder, `${name}.mjs`));
    const said = execFileSync('node', [`${name}.mjs`], { cwd: folder, encoding: 'utf8' }), hits = [...said.matchAll(/^(\d+) ms: ([\d.]+) N s$/gm)].map(([, ms, impulse]) => ({ ms: Number(ms), impulse: Number(impulse) }));
    assert.ok(hits.length >= 2 && hits.length <= 6, said);
    assert.ok(Math.abs(hits[0].ms - 404) < 20 && Math.abs(hits[0].impulse / due - 1) < 0.1, `${said}; due ${due.toFixed(2)} N s at 404 ms`);
    console.log(`${name}: ${hits.map(({ ms, impulse }) => `${ms} ms ${impulse}`).join(', ')}`);
});
