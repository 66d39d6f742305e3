// SPDX-License-Identifier: MIT
// 2,000 contacts in one step: how many are felt, which, and what it costs: storm.mjs FOLDER.
import assert from 'node:assert/strict';
import { load } from './installed.mjs';

const physvib = await (await load(process.argv[2], 'physvib')).load(), world = physvib.world(), count = 2000;
world.setBody(0);
for (let i = 1; i <= count; ++i) world.setBody(i, { massKg: 0.1, isSource: true, frequencyHz: 60 + 0.2 * i, decayPerSecond: 20 });
world.step(0.01, 9.81);
const begin = performance.now();
world.step(0.01, 9.81, () => { for (let i = 1; i <= count; ++i) world.touch(i, 0, { x: i / count, y: 0.5, normalX: 0, normalY: -1, approach: 0.1 + 0.001 * i }); });
const events = world.take(true), stepped = performance.now();
physvib.render(events, { seconds: 0.1, fieldWidth: 1, fieldHeight: 1 });
console.log(`JavaScript: ${events.length} of ${count} felt, ${world.counts.dropped} dropped, ${(stepped - begin).toFixed(0)} ms in the step, ${(performance.now() - stepped).toFixed(0)} ms for 0.1 s of sound`);
assert.equal(events.length, 1024);
assert.equal(world.counts.dropped, count - 1024);
assert.ok(events.every(({ fixture }) => fixture > count - 1024), 'the strongest');
