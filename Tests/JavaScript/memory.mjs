// SPDX-License-Identifier: MIT
// What 10,000 lives leave behind in each engine of the kit: node --expose-gc memory.mjs FOLDER [ENGINE...]. Each ball is made, set, falls, is felt, goes. Of what the first 2,000
// have left, and all: the difference, less that of the engine alone, may be 1 MB of
// JavaScript's, and nothing that haptics know.
import assert from 'node:assert/strict';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import test from 'node:test';
import { load } from './installed.mjs';
import { drivers } from './Kit/drivers.mjs';

setFlagsFromString('--expose-gc');
const gc = runInNewContext('gc'), [folder, ...names] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load(), source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 };
const lives = 10000, lanes = 50, seconds = 1 / 60;

/** MB that later lives left, how many were felt, how many are known. */
async function live(make, isFelt) {
    const driver = await make(folder, physvib, { gravity: 9.81 }), haptics = isFelt || driver.needsHaptics ? driver.attach() : null;
    driver.create({ type: 'fixed', x: 0, y: -0.5, half: [60, 0.5] });
    let felt = 0, first = 0;
    const used = async () => { for (let i = 0; i < 3; ++i) { gc(); await new Promise(done => setTimeout(done, 1)); } return process.memoryUsage().heapUsed / 1e6; };
    const alone = { step: (length, advance) => advance?.(length), update: length => driver.advance?.(length) };
    for (let life = 0; life < lives; life += lanes) {
        const balls = Array.from({ length: lanes }, (_, i) => driver.create({ radius: 0.1, massKg: 0.3, x: i - lanes / 2, y: 0.2 }));
        if (haptics) for (const ball of balls) haptics.set(ball, source);
        for (let k = 0; k < 12; ++k) driver.step(seconds, haptics ?? alone);
        for (const ball of balls) driver.remove(ball);
        driver.step(seconds, haptics ?? alone);
        if (haptics) felt += new Set(haptics.take(true).map(({ fixture }) => fixture)).size;
        if (life === 2000 - lanes) first = await used();
    }
    const left = await used() - first, known = haptics ? [...haptics.each()].length : 0;
    assert.equal(haptics?.error ?? null, null);
    haptics?.free();
    driver.end?.();
    return { left, felt, known };
}

for (const [name, make] of Object.entries(drivers)) if (names.length > 0 ? names.includes(name) : name !== 'mujoco') test(name, async () => { // a model's bodies live as long as it
    const { left, felt, known } = await live(make, true), alone = left < 1 ? 0 : (await live(make, false)).left;
    console.log(`${name}: ${felt} of ${lives} felt, ${left.toFixed(2)} MB more than behind 2,000${alone ? `, the engine alone ${alone.toFixed(2)}` : ''}, ${known} known`);
    assert.ok(felt === lives && left - alone < 1 && known <= 1);
});

test('Matter: what has left the world is kept by nobody', async () => {
    const { attach } = await load(folder, 'physvib/matter'), { default: Matter } = await load(folder, 'matter-js'), engine = Matter.Engine.create(), haptics = attach(physvib, engine), kept = [];
    for (let i = 0; i < 300; ++i) {
        const body = Matter.Bodies.circle(100, 100, 10);
        Matter.Composite.add(engine.world, body);
        haptics.set(body, { isSource: true, frequencyHz: 200, decayPerSecond: 30 });
        Matter.Engine.update(engine, 10);
        Matter.Composite.remove(engine.world, body);
        kept.push(new WeakRef(body));
    }
    for (let i = 0; i < 4; ++i) { Matter.Engine.update(engine, 10); await new Promise(setImmediate); gc(); }
    const count = kept.filter(body => body.deref()).length;
    assert.ok(count < 10, `${count} of 300 are kept`);
    haptics.free();
});
