// SPDX-License-Identifier: MIT
// What haptics cost of a picture of 16.7 ms: cost.mjs FOLDER [BODIES...]. A pile of balls in a box, a tenth of them sources, at 60 steps a second; the engine alone and
// with the attachment, medians of the steps from the third second on, in turns. The motion is the same to the bit, or it fails.
import assert from 'node:assert/strict';
import { load } from './installed.mjs';

const [folder, ...given] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load();
const seconds = 1 / 60, warm = 120, measured = 240, radius = 0.1, source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 };
const placesOf = count => { const wide = Math.ceil(Math.sqrt(count)); return Array.from({ length: count }, (_, i) => ({ x: 0.5 + 0.25 * (i % wide) + 0.01 * (Math.floor(i / wide) % 3), y: 0.2 + 0.25 * Math.floor(i / wide) })); };
const widthOf = count => 1 + 0.25 * Math.ceil(Math.sqrt(count));

const engines = {
    async matter(count) {
        const { default: Matter } = await load(folder, 'matter-js'), { attach } = await load(folder, 'physvib/matter'), engine = Matter.Engine.create(), px = 100, width = widthOf(count);
        const wall = (x, y, w, h) => Matter.Bodies.rectangle(x * px, -y * px, w * px, h * px, { isStatic: true });
        Matter.Common._nextId = 0;
        const bodies = placesOf(count).map(({ x, y }) => Matter.Bodies.circle(x * px, -y * px, radius * px, { restitution: 0.3 }));
        Matter.Composite.add(engine.world, [wall(width / 2, -0.5, width + 2, 1), wall(-0.5, 10, 1, 40), wall(width + 0.5, 10, 1, 40), ...bodies]);
        return { bodies, attach: options => attach(physvib, engine, { ...options, metresPerUnit: 1 / px }), step: () => Matter.Engine.update(engine, 1000 / 60), stateOf: body => [body.position.x, body.position.y, body.angle] };
    },
    async planck(count) {
        const P = await load(folder, 'planck').then(module => module.default ?? module), { attach } = await load(folder, 'physvib/planck'), world = new P.World({ gravity: { x: 0, y: -9.81 } }), width = widthOf(count);
        const wall = (x, y, w, h) => world.createBody().createFixture(new P.Box(w / 2, h / 2, { x, y }));
        wall(width / 2, -0.5, width + 2, 1); wall(-0.5, 10, 1, 40); wall(width + 0.5, 10, 1, 40);
        const bodies = placesOf(count).map(position => { const body = world.createBody({ type: 'dynamic', position }); body.createFixture(new P.Circle(radius), { density: 1, restitution: 0.3 }); return body; });
        return { bodies, attach: options => attach(physvib, world, options), step: () => world.step(seconds), stateOf: body => [body.getPosition().x, body.getPosition().y, body.getAngle()] };
    },
    async rapier2d(count) {
        const { default: R } = await load(folder, '@dimforge/rapier2d-compat'), { attach } = await load(folder, 'physvib/rapier2d');
        await R.init();
        const world = new R.World({ x: 0, y: -9.81 }), width = widthOf(count);
        world.timestep = seconds;
        const ground = world.createRigidBody(R.RigidBodyDesc.fixed()), wall = (x, y, w, h) => world.createCollider(R.ColliderDesc.cuboid(w / 2, h / 2).setTranslation(x, y), ground);
        wall(width / 2, -0.5, width + 2, 1); wall(-0.5, 10, 1, 40); wall(width + 0.5, 10, 1, 40);
        const bodies = placesOf(count).map(({ x, y }) => { const body = world.createRigidBody(R.RigidBodyDesc.dynamic().setTranslation(x, y)); world.createCollider(R.ColliderDesc.ball(radius).setRestitution(0.3), body); return body; });
        let haptics;
        return { bodies, attach(options) { haptics = attach(physvib, world, options); return haptics; }, step: () => (haptics ? haptics.update(seconds) : world.step()), stateOf: body => [body.translation().x, body.translation().y, body.rotation()] };
    },
};

const median = list => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
console.log('| engine | bodies | engine alone, ms | with haptics, ms | haptics, ms |\n| --- | --- | --- | --- | --- |');
for (const count of given.length ? given.map(Number) : [100, 1000]) for (const [name, make] of Object.entries(engines)) {
    const [alone, felt] = [await make(count), await make(count)], haptics = felt.attach({ fieldWidth: 20, fieldHeight: 20 }), times = [[], []];
    felt.bodies.forEach((body, i) => { if (i % 10 === 0) haptics.set(body, source); });
    let events = 0;
    for (let i = 0; i < warm + measured; ++i) for (const [j, { step }] of [alone, felt].entries()) {
        const began = performance.now();
        step();
        if (i >= warm) times[j].push(performance.now() - began);
        if (j === 1) events += haptics.take().length;
    }
    assert.deepEqual(felt.bodies.map(felt.stateOf), alone.bodies.map(alone.stateOf), `${name}: the motion differs`);
    assert.ok(events > 0 && haptics.error === null);
    const [a, b] = times.map(median);
    console.log(`| ${name} | ${count} | ${a.toFixed(2)} | ${b.toFixed(2)} | ${(b - a).toFixed(2)} |`);
}
