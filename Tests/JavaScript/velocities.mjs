// SPDX-License-Identifier: MIT
// Engines that tell velocities and boxes alone, as a game's own: velocities.mjs FOLDER. What is felt is what the step did; what is no impact is not felt.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load(), { attachVelocities } = await load(folder, 'physvib/velocities');
const source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 }, gravity = { x: 0, y: 1000 }, seconds = 1 / 60, floorTop = 500;

/** Boxes and circles in pixels, y downwards: they fall, and bounce off what nothing moves, and off one another along x. */
function game(...bodies) {
    const floor = { x: 400, y: floorTop + 50, vx: 0, vy: 0, width: 800, height: 100, massKg: 0 }, all = new Set([floor, ...bodies]);
    const halfOf = body => body.radius ?? body.height / 2;
    function advance() {
        for (const body of all) {
            if (!(body.massKg > 0)) continue;
            if (!body.floats) body.vy += gravity.y * seconds;
            body.x += body.vx * seconds;
            body.y += body.vy * seconds;
            if (!body.isGhost && body.y + halfOf(body) > floorTop && body.vy > 0) { body.y = floorTop - halfOf(body); body.vy *= -body.bounce; }
        }
        for (const a of all) for (const b of all) { // of equal masses: they exchange velocities
            if (a === b || !(a.massKg > 0 && b.massKg > 0) || a.isGhost || b.isGhost || a.x > b.x || b.x - a.x > (a.width + b.width) / 2 || Math.abs(a.y - b.y) > 20 || a.vx <= b.vx) continue;
            [a.vx, b.vx] = [b.vx, a.vx];
        }
    }
    const engine = { bodies: () => all, read: (body, to) => Object.assign(to, { x: body.x, y: body.y, vx: body.vx, vy: body.vy, width: body.width, height: body.height, radius: body.radius ?? 0, massKg: body.massKg, gravityScale: body.floats ? 0 : 1 }), gravity };
    const haptics = attachVelocities(physvib, engine, { metresPerUnit: 0.01, fieldWidth: 8, fieldHeight: 6 }), felt = [];
    let time = 0;
    const step = (count = 1, look = true) => {
        for (let i = 0; i < count; ++i, time += seconds) {
            if (look) haptics.look();
            advance();
            haptics.update(seconds);
            felt.push(...haptics.take());
        }
        return felt;
    };
    return { all, haptics, step };
}
const box = values => ({ x: 400, y: 300, vx: 0, vy: 0, width: 40, height: 40, massKg: 2, bounce: 0, ...values });

test('a box and a ball that land are felt once, where and as hard as they land', () => {
    for (const shape of [{}, { radius: 20 }]) for (const look of [true, false]) {
        const body = box(shape), { haptics, step } = game(body), id = haptics.set(body, source), events = step(90, look);
        assert.equal(haptics.error, null);
        assert.equal(events.length, 1, haptics.explain());
        const [hit] = events, speed = Math.sqrt(2 * 9.81 * 1.8 * 10 / 9.81); // m/s, from 1.8 m at 10 m/s2
        assert.equal(hit.fixture, id);
        assert.ok(Math.abs(hit.x - 4) < 0.25 && Math.abs(hit.y - (6 - floorTop / 100)) < 0.01, JSON.stringify(hit));
        assert.ok(Math.abs(hit.impulse / (2 * speed) - 1) < 0.05, `${hit.impulse} N s, due ${2 * speed}`);
        assert.ok(Math.abs(hit.timeNs * 1e-9 - Math.sqrt(2 * 1.8 / 10)) < 1.5 * seconds, `${hit.timeNs}`);
    }
});

test('one that bounces is felt at each landing, weaker', () => {
    const body = box({ radius: 20, bounce: 0.5 }), { haptics, step } = game(body);
    haptics.set(body, source);
    const events = step(130);
    assert.ok(events.length >= 3 && events[1].impulse < 0.7 * events[0].impulse && events[2].impulse < 0.8 * events[1].impulse, JSON.stringify(events.map(event => event.impulse)));
});

test('a jump, a stop in the air and what passes through are not felt', () => {
    const body = box(), ghost = box({ x: 600, isGhost: true, y: 420 }), { haptics, step } = game(body, ghost);
    for (const each of [body, ghost]) haptics.set(each, source);
    step(60);
    const before = step().length;
    body.vy = -400; // it stands, and jumps
    step(10);
    body.vy = 0;
    body.vx = 300;
    step(3);
    assert.equal(step().length, before);
    assert.equal(before, 1, 'its first landing alone');
    assert.equal(step(60).length, 2, 'it lands again');
});

test('two that meet are both felt; bodies come and go', () => {
    const [a, b] = [box({ x: 200, vx: 300, floats: true }), box({ x: 400, vx: -100, floats: true })], { all, haptics, step } = game(a, b), ids = [a, b].map(body => haptics.set(body, source));
    const events = step(40);
    assert.deepEqual(events.map(event => event.fixture).sort(), ids);
    for (const event of events) assert.ok(Math.abs(event.impulse - 2 * 4) < 0.01 && event.x > 3 && event.x < 4, JSON.stringify(event));
    all.delete(b);
    step(3);
    all.add(b);
    Object.assign(b, { x: a.x + 100, vx: a.vx - 100, y: a.y });
    assert.equal(step(40).length, 4);
    assert.equal(haptics.id(b), ids[1]);
    haptics.free();
    step(2);
});

test('a body with numbers that are none is left out, and told; the others are felt', () => {
    const [a, b] = [box({ x: 200 }), box({ x: 600 })], { haptics, step } = game(a, b), [, id] = [a, b].map(body => haptics.set(body, source));
    a.vx = NaN;
    const events = step(60);
    assert.deepEqual(events.map(event => event.fixture), [id]);
    assert.equal(haptics.error, null);
    assert.match(haptics.explain(), /^Body 0 is left out/);
});

test('what is no engine is refused', () => {
    assert.throws(() => attachVelocities(physvib, {}), /bodies and read/);
    const haptics = attachVelocities(physvib, { bodies: () => [], read: (body, to) => Object.assign(to, { x: 1, y: 1, vx: 1 }) });
    assert.throws(() => haptics.set({}, source), /expected that read gives .*vy: undefined/);
    const engine = { bodies: () => [], read() {} };
    assert.throws(() => attachVelocities(physvib, { ...engine, gravty: gravity }), { message: 'attachVelocities: expected members bodies, read, gravity, bounds, bodyOf, tells, found gravty' });
    assert.throws(() => attachVelocities(Promise.resolve(physvib), engine), { message: 'attach: expected the library (await load()), found Promise' });
    assert.throws(() => attachVelocities(physvib, engine, { fieldWith: 8 }), /^PhysVibError: fieldWith: expected one of .*fieldWidth.*fieldHeight, metresPerUnit, yDown$/);
    for (const metresPerUnit of [0, -1, NaN, '0.01 m']) assert.throws(() => attachVelocities(physvib, engine, { metresPerUnit }), /metresPerUnit: expected a number above 0, found/);
    assert.throws(() => physvib.world({ gravty: 1 }), /^PhysVibError: gravty: expected one of .*, fieldHeight$/);
    new (class { bodies = () => []; name = 'of a game'; read() {} haptics = attachVelocities(physvib, this); })();
});

test('who calls update is told of update', () => {
    const body = box(), { haptics } = game(body);
    haptics.set(body, source);
    assert.match(haptics.explain(), /^No step has been made: make one for each step of the engine \(update\)\.$/);
    haptics.update(0);
    assert.match(haptics.explain(), /give update the seconds since/);
});

test('a thing without a body is told to who sets it, and ends nothing', () => {
    const a = box({ x: 200 }), haptics = attachVelocities(physvib, { bodies: () => [a], read: (thing, to) => Object.assign(to, { x: thing.x.valueOf(), y: thing.y, vx: thing.vx, vy: thing.vy }), bodyOf: thing => thing.body ?? thing });
    assert.throws(() => haptics.set({}, source), /expected one of the engine's/);
    assert.equal(haptics.error, null);
    assert.equal(haptics.set(a, source), 0);
    haptics.free();
});
