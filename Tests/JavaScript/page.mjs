// SPDX-License-Identifier: MIT
// The program of a page, as its reader runs it, and its types: page.mjs FOLDER PAGE. FOLDER: where npm has installed physvib, matter-js and typescript.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const [folder, page] = process.argv.slice(2), text = readFileSync(page, 'utf8');
const [, program] = text.match(/```js drop\.mjs\n(.*?)```/s);
writeFileSync(join(folder, 'drop.mjs'), program);
const said = execFileSync('node', ['drop.mjs'], { cwd: folder, encoding: 'utf8' }), [, hits, seconds] = said.match(/(\d+) hits, the first at ([\d.]+) s/);
assert.ok(Number(hits) >= 3 && Number(seconds) > 0.72 && Number(seconds) < 0.79, said); // 0.721 s by free fall (Matter's gravity is 10 m/s^2 at 100 pixels a metre), and its air slows
assert.equal(readFileSync(join(folder, 'drop.wav')).toString('latin1', 0, 4), 'RIFF');

// What is not there is an error by its types.
writeFileSync(join(folder, 'types.mts'), `${program.replace("import Matter from 'matter-js';", 'declare const Matter: any;').replace(/import \{ writeFileSync.*\n/, 'declare const writeFileSync: any;\n')}
import { play } from 'physvib/audio';
import { rumble } from 'physvib/gamepad';
import { attach as box2d3 } from 'physvib/box2d3';
import { attach as planck } from 'physvib/planck';
import { attach as rapier3d } from 'physvib/rapier3d';
import { attach as cannon } from 'physvib/cannon';
import { attach as havok } from 'physvib/havok';
import { attach as jolt } from 'physvib/jolt';
import { attach as mujoco } from 'physvib/mujoco';
import { hands } from 'physvib/xr';
import { attachVelocities } from 'physvib/velocities';
import { load as loadInline } from 'physvib/inline';
import wasm from 'physvib/physvib.wasm';
import worklet from 'physvib/worklet.js';
const output = await play(physvib, new AudioContext(), { layout: 'ring3', outputs: [3, 1, 2] });
output.follow(haptics);
output.onstate = ({ state }) => { if (state === 'device lost') output.resume().then((isRunning: boolean) => isRunning); };
output.addEventListener('state', event => event.state === 'late');
const [left] = output.left(0, 1), hasLeft: boolean = left!.running && left!.peak > 0 && left!.meanSquare > 0 && left!.frames > output.dropped, over: Promise<void> = output.buzz(0);
// @ts-expect-error: no such state
output.onstate = ({ state }) => state === 'lost';
rumble(physvib, { profile: 'pad-xbox' }).follow(haptics);
box2d3(physvib, {}, { b2: {}, metresPerUnit: 1 }).update(0.01);
planck(physvib, {}).update(1 / 60);
rapier3d(physvib, {}).update(1 / 60);
cannon(physvib, {}).update(1 / 60);
havok(physvib, { havok: {}, world: [1n], bodies: () => [[1n]] }, { fieldWidth: 8 }).set([1n]);
jolt(physvib, { Jolt: {}, interface: {} }).update(1 / 60);
mujoco(physvib, { mujoco: {}, model: {}, data: {} }, { restitution: 0.5 }).set('ball');
hands(physvib, () => null).follow(haptics, { left: ball, right: [ball] })();
// @ts-expect-error: no such hand
hands(physvib, {}).follow(haptics, { foot: ball });
const own = attachVelocities(physvib, { bodies: () => [{ at: 1 }], read: (body: { at: number }, to) => Object.assign(to, { x: body.at, y: 0, vx: 0, vy: 0 }), gravity: { x: 0, y: 9.81 } }, { fieldWidth: 8, yDown: false });
own.look();
own.update(1 / 60);
const inside: Promise<typeof physvib> = loadInline(), elsewhere = load(wasm);
await play(physvib, new AudioContext(), { worklet });
// @ts-expect-error: Matter steps itself
haptics.update(1 / 60);
const world = physvib.world({ fieldWidth: 1, fieldHeight: 1 });
world.step(0.01, 9.81, () => world.touch(0, 1, { x: 0, y: 0, approach: 1, restitution: 0.5, gap: 0.01, impulse: 1, point: 'place' }));
const samples: Float32Array = channels[0];
// @ts-expect-error: no such value
haptics.set(ball, { frequency: 200 });
`);
execFileSync('node', [join(folder, 'node_modules/typescript/bin/tsc'), '--noEmit', '--strict', '--module', 'nodenext', '--target', 'es2022', '--lib', 'es2022,dom', 'types.mts'], { cwd: folder, stdio: 'inherit' });
console.log(`${page}: ${said.trim()}`);
