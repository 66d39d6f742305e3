// SPDX-License-Identifier: MIT
// Bodies that come, change and go while an attachment follows, in each engine: bodies.mjs FOLDER.
import assert from 'node:assert/strict';
import test from 'node:test';
import { engines } from './engines.mjs';
import { load } from './installed.mjs';

const [folder] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load();
const world = { gravity: 9.81, restitution: 0.3, friction: 0.2, falls: true, bodies: [{ id: 0, halfWidth: 5, halfHeight: 0.5, x: 0, y: -0.5, isStatic: true }, { id: 1, radius: 0.1, x: 0, y: 0.3, massKg: 0.2 }, { id: 2, radius: 0.1, x: 1, y: 0.3, massKg: 0.2 }] };

for (const name of Object.keys(engines)) test(name, async () => {
    const { haptics, bodies, step, destroy } = await engines[name](folder, physvib, world, 240);
    const first = haptics.set(bodies.get(1), { isSource: true, frequencyHz: 200, decayPerSecond: 30 }), told = [];
    haptics.set(bodies.get(2), { frequencyHz: 200, decayPerSecond: 30 });
    const end = haptics.follow(events => told.push(...events));
    for (let i = 0; i < 120; ++i) step(1 / 240);
    end();
    const events = haptics.take();
    assert.deepEqual(told, events);
    assert.ok(events.length > 0 && events.every(event => event.fixture === first), 'the haptic source alone is felt');
    assert.deepEqual(haptics.take(), []);
    haptics.remove(bodies.get(1));
    haptics.set(bodies.get(2), { isSource: true, frequencyHz: 100, decayPerSecond: 30 });
    for (let i = 0; i < 240; ++i) step(1 / 240);
    assert.ok(haptics.take(true).every(event => event.fixture !== first && event.frequencyHz === 100), 'what was removed is felt no more');
    assert.throws(() => haptics.set(bodies.get(2), { frequencyHz: -1 }), /expected/);
    assert.notEqual(haptics.id(bodies.get(1)), first);
    destroy(1); // a body that leaves needs no word
    for (let i = 0; i < 10; ++i) step(1 / 240);
    assert.match(haptics.explain(), /\w/);
    haptics.free();
    assert.throws(() => haptics.counts, /handle/);
    if (name === 'matter' || name === 'planck') step(1 / 240); // their own loop goes on
});

/** What the console is told while `run` runs. */
function toldBy(run) {
    const told = [], { error } = console;
    console.error = line => told.push(line);
    try { run(); } finally { console.error = error; }
    return told;
}

for (const name of Object.keys(engines)) test(`${name}: errors of haptics are not the game's`, async () => {
    const make = async () => {
        const made = await engines[name](folder, physvib, world, 240), ids = [1, 2].map(id => made.haptics.set(made.bodies.get(id), { isSource: true, frequencyHz: 200, decayPerSecond: 30 }));
        return { ...made, ids, run(count) { for (let i = 0; i < count; ++i) made.step(1 / 240); return made.haptics.take(true); } };
    };
    const one = await make(), { journal } = one.haptics, { move, touch } = journal, [bad] = one.ids;
    journal.move = (id, x, ...rest) => move.call(journal, id, id === bad ? NaN : x, ...rest);
    journal.touch = (a, b, contact) => touch.call(journal, a, b, a === bad || b === bad ? { ...contact, x: NaN } : contact);
    assert.deepEqual([...new Set(one.run(120).map(event => event.fixture))], [one.ids[1]], 'a body with a place that is none is left out alone');
    assert.match(one.haptics.explain(), new RegExp(`Body ${bad} is left out while`));
    assert.equal(one.haptics.error, null);
    one.haptics.free();
    one.haptics.free();

    const two = await make(), heard = [];
    two.haptics.follow(() => { throw new Error('mine'); });
    two.haptics.follow(events => heard.push(...events));
    assert.equal(toldBy(() => two.run(120)).length, 1, 'a follower is told once');
    assert.ok(heard.length > 0, 'another goes on');
    assert.match(two.haptics.explain(), /A follower has ended by an error: mine/);

    two.haptics.world.take = two.haptics.world.endStep = () => { throw new Error('broken'); };
    const told = toldBy(() => two.run(3));
    assert.equal(told.length, 1);
    assert.match(told[0], /haptics have ended, the game goes on: broken/);
    assert.equal(two.haptics.set(two.bodies.get(1), { isSource: true }), -1);
    assert.equal(two.haptics.id(two.bodies.get(1)), -1);
    two.haptics.remove(two.bodies.get(1));
    assert.deepEqual(two.haptics.take(true), []);
    assert.match(two.haptics.explain(), /ended by an error: broken/);
    two.haptics.free();
    two.step(1 / 240);
});

test('a scene of Phaser that ends has taken the events off', async () => {
    const engine = { world: { bodies: [], composites: [] }, pairs: { list: [] }, timing: { lastDelta: 16 }, gravity: { x: 0, y: 1, scale: 0.001 } }, { attach } = await load(folder, 'physvib/matter'), haptics = attach(physvib, engine);
    engine.events = {}; // Events.off(engine)
    assert.match(haptics.explain(), /no longer reach these haptics/);
    haptics.free();
});

test('there is no room for the 257th attachment: haptics end, the game goes on', async () => {
    const { attach } = await load(folder, 'physvib/matter'), { default: Matter } = await load(folder, 'matter-js'), all = [];
    let last;
    const told = toldBy(() => { while ((last = attach(physvib, Matter.Engine.create())).error === null) all.push(last); });
    assert.match(told[0], /the game goes on: worlds: expected at most 256/);
    assert.equal(last.set(Matter.Bodies.circle(0, 0, 10), {}), -1);
    assert.deepEqual([last.take(), last.counts], [[], undefined]);
    assert.match(last.explain(), /expected at most 256.*free\(\)/);
    for (const each of [last, ...all]) each.free();
});

const none = { category: 1, mask: 0, group: 0 };
const hinder = {
    matter: { sensor: body => { body.isSensor = true; }, filtered: body => { body.collisionFilter = none; } },
    planck: { sensor: body => body.getFixtureList().setSensor(true), filtered: body => body.getFixtureList().setFilterData({ groupIndex: 0, categoryBits: 1, maskBits: 0 }),
        disabled: body => body.setActive(false), asleep: body => body.setAwake(false) },
    rapier2d: { sensor: body => body.collider(0).setSensor(true), filtered: body => body.collider(0).setCollisionGroups(0x00010000), disabled: body => body.setEnabled(false),
        asleep: body => body.sleep() },
};
hinder.phaser = hinder.matter;
for (const [name, states] of Object.entries(hinder)) test(`${name} says why a source touches nothing`, async () => {
    for (const [state, make] of Object.entries(states)) {
        const { haptics, bodies, step } = await engines[name](folder, physvib, { ...world, bodies: [world.bodies[0], { ...world.bodies[1], y: 3 }] }, 240); // far from what wakes it
        haptics.set(bodies.get(1), { isSource: true, frequencyHz: 200, decayPerSecond: 30 });
        make(bodies.get(1));
        for (let i = 0; i < 3; ++i) step(1 / 240);
        assert.match(haptics.explain(), new RegExp(`body ${haptics.id(bodies.get(1))} is ${state === 'sensor' ? 'a sensor' : state}`), state);
        haptics.free();
    }
});
