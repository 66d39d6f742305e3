// SPDX-License-Identifier: MIT
// A thousand random lives in each engine: lives.mjs FOLDER [SEED]. Bodies are made, set, removed, remade, pooled, put to sleep, made sensors; worlds are cleared and
// filled, haptics freed and attached. Then all fall: a model knows who is felt, and nobody else may be.
import assert from 'node:assert/strict';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder, seed = '1'] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load();
const lanes = 10, lives = 1000, seconds = 1 / 120, stepsOfFall = 60, height = 0.3, radius = 0.05, options = { fieldWidth: 20, fieldHeight: 4 };
const source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 };
function randomOf(state) {
    return count => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return Math.floor(state / 2 ** 32 * count);
    };
}

/** What the lives do in an engine. Places are metres, y upwards; a compound has two circles. */
const engines = {
    async matter() {
        const { default: Matter } = await load(folder, 'matter-js'), { attach } = await load(folder, 'physvib/matter'), px = 100, engine = Matter.Engine.create();
        const ground = Matter.Bodies.rectangle(1000, 50, 4000, 100, { isStatic: true }), { world } = engine, collisions = [];
        Matter.Composite.add(world, ground);
        Matter.Events.on(engine, 'collisionStart', () => { for (const act of collisions.splice(0)) act(); });
        return {
            attach: () => attach(physvib, engine, { ...options, metresPerUnit: 1 / px }), pools: true,
            make(x, isCompound) {
                const circle = at => Matter.Bodies.circle(at * px, -2 * px, radius * px, { restitution: 0.3 });
                const body = isCompound ? Matter.Body.create({ parts: [circle(x), circle(x + radius)], restitution: 0.3 }) : circle(x);
                Matter.Composite.add(world, body);
                return body;
            },
            partOf: body => body.parts.at(-1), remove: body => Matter.Composite.remove(world, body), add: body => Matter.Composite.add(world, body),
            clear(isWhole) { Matter.Composite.clear(world, false); if (isWhole) Matter.Engine.clear(engine); Matter.Composite.add(world, ground); },
            sleep: body => Matter.Sleeping.set(body, true), sensor: (body, is) => body.parts.forEach(part => { part.isSensor = is; }),
            place(body, x) {
                Matter.Sleeping.set(body, false);
                Matter.Body.setPosition(body, { x: x * px, y: -(height + radius) * px });
                for (const set of ['setVelocity', 'setAngularVelocity', 'setAngle']) Matter.Body[set](body, set === 'setVelocity' ? { x: 0, y: 0 } : 0);
            },
            step() { Matter.Engine.update(engine, seconds * 1000); for (const act of collisions.splice(0)) act(); }, within: act => collisions.push(act), // or behind a step without any
        };
    },
    async planck() {
        const { default: P } = await load(folder, 'planck').then(module => ({ default: module.default ?? module })), { attach } = await load(folder, 'physvib/planck'), world = new P.World({ gravity: { x: 0, y: -9.81 } });
        const floor = () => world.createBody().createFixture(new P.Box(20, 0.5, { x: 10, y: -0.5 }));
        floor();
        return {
            attach: () => attach(physvib, world, options),
            make(x, isCompound) {
                const body = world.createBody({ type: 'dynamic', position: { x, y: 2 } });
                for (const at of isCompound ? [0, radius] : [0]) body.createFixture(new P.Circle({ x: at, y: 0 }, radius), { density: 1, restitution: 0.3 });
                return body;
            },
            partOf: body => body.getFixtureList(), remove: body => world.destroyBody(body),
            clear() { for (let body = world.getBodyList(); body; body = body.getNext()) world.destroyBody(body); floor(); },
            sleep: body => body.setAwake(false), sensor(body, is) { for (let fixture = body.getFixtureList(); fixture; fixture = fixture.getNext()) fixture.setSensor(is); },
            place(body, x) { body.setTransform({ x, y: height + radius }, 0); body.setLinearVelocity({ x: 0, y: 0 }); body.setAngularVelocity(0); body.setAwake(true); },
            step: () => world.step(seconds), within: act => act(), // it is locked within a step
        };
    },
    async velocities() { // a game's own physics
        const { attachVelocities } = await load(folder, 'physvib/velocities'), bodies = new Set(), floor = { x: 10, y: -0.5, vx: 0, vy: 0, width: 40, height: 1, massKg: 0 };
        bodies.add(floor);
        let inStep = [];
        const advance = () => {
            for (const body of bodies) {
                if (!(body.massKg > 0) || body.isAsleep) continue;
                body.vy -= 9.81 * seconds;
                body.y += body.vy * seconds;
                if (!body.isSensor && bodies.has(floor) && body.y < radius && body.y > -radius && body.vy < 0) { body.y = radius; body.vy *= -0.3; }
            }
            for (const act of inStep.splice(0)) act();
        };
        return {
            attach: () => attachVelocities(physvib, { bodies: () => [...bodies].filter(body => !body.isSensor), read: (body, to) => Object.assign(to, body), gravity: { x: 0, y: -9.81 }, bodyOf: thing => thing.whole ?? thing }, { ...options, metresPerUnit: 1, yDown: false }),
            pools: true,
            make(x) { const body = { x, y: 2, vx: 0, vy: 0, radius, massKg: 0.1 }; bodies.add(body); return body; },
            partOf: body => ({ whole: body }), remove: body => bodies.delete(body), add: body => bodies.add(body),
            clear() { bodies.clear(); bodies.add(floor); },
            sleep: body => { body.isAsleep = true; }, sensor: (body, is) => { body.isSensor = is; },
            place: (body, x) => Object.assign(body, { x, y: height + radius, vx: 0, vy: 0, isAsleep: false }),
            step: haptics => haptics.step(seconds, advance), within: act => inStep.push(act),
        };
    },
    rapier2d: () => rapier('2d', (x, y) => ({ x, y }), 0),
    rapier3d: () => rapier('3d', (x, y) => ({ x, y, z: 0 }), { x: 0, y: 0, z: 0, w: 1 }),
    async box2d3() {
        const path = join(resolve(folder), 'node_modules/box2d3-wasm/build/dist/es/entry.mjs'), b2 = await (await import(pathToFileURL(path))).default(), { attach } = await load(folder, 'physvib/box2d3');
        const settings = b2.b2DefaultWorldDef();
        settings.gravity.Set(0, -9.81);
        const world = b2.b2CreateWorld(settings), all = new Set();
        const shape = (body, x, y, size, isBox) => {
            const def = b2.b2DefaultShapeDef();
            def.material.restitution = 0.3;
            if (isBox) return b2.b2CreatePolygonShape(body, def, b2.b2MakeOffsetBox(20, 0.5, new b2.b2Vec2(10, -0.5), b2.b2MakeRot(0)));
            const circle = new b2.b2Circle();
            circle.center.Set(x, y);
            circle.radius = size;
            return b2.b2CreateCircleShape(body, def, circle);
        };
        const floor = () => { const body = b2.b2CreateBody(world, b2.b2DefaultBodyDef()); shape(body, 0, 0, 0, true); all.add(body); };
        floor();
        const free = body => { all.delete(body); b2.b2DestroyBody(body); };
        let inStep = [];
        return {
            attach: () => attach(physvib, world, { ...options, b2 }), hasNoSensors: true,
            make(x, isCompound) {
                const def = b2.b2DefaultBodyDef();
                def.type = b2.b2BodyType.b2_dynamicBody;
                def.position.Set(x, 2);
                const body = b2.b2CreateBody(world, def);
                for (const at of isCompound ? [0, radius] : [0]) shape(body, at, 0, radius);
                all.add(body);
                return body;
            },
            partOf: body => body, remove: free, clear() { [...all].forEach(free); floor(); },
            sleep: body => b2.b2Body_SetAwake(body, false), sensor() {},
            place(body, x) { b2.b2Body_SetTransform(body, new b2.b2Vec2(x, height + radius), b2.b2MakeRot(0)); b2.b2Body_SetLinearVelocity(body, new b2.b2Vec2(0, 0)); b2.b2Body_SetAngularVelocity(body, 0); b2.b2Body_SetAwake(body, true); },
            step: haptics => haptics.step(seconds, () => { b2.b2World_Step(world, seconds, 4); for (const act of inStep.splice(0)) act(); }), within: act => inStep.push(act),
        };
    },
};

async function rapier(kind, at, unturned) {
    const { default: R } = await load(folder, `@dimforge/rapier${kind}-compat`), { attach } = await load(folder, `physvib/rapier${kind}`);
    await R.init();
    const world = new R.World(at(0, -9.81)), is3d = kind === '3d';
    const floor = isBody => { // a ground is often a collider without a body
        const desc = is3d ? R.ColliderDesc.cuboid(20, 0.5, 5) : R.ColliderDesc.cuboid(20, 0.5);
        if (isBody) world.createCollider(desc, world.createRigidBody(R.RigidBodyDesc.fixed().setTranslation(...Object.values(at(10, -0.5)))));
        else world.createCollider(desc.setTranslation(...Object.values(at(10, -0.5))));
    };
    floor(false);
    const inStep = [];
    return {
        attach: () => attach(physvib, world, options),
        make(x, isCompound) {
            const body = world.createRigidBody(R.RigidBodyDesc.dynamic().setTranslation(...Object.values(at(x, 2))));
            for (const beside of isCompound ? [0, radius] : [0]) world.createCollider(R.ColliderDesc.ball(radius).setRestitution(0.3).setTranslation(...Object.values(at(beside, 0))), body);
            return body;
        },
        partOf: body => body.collider(0), remove: body => world.removeRigidBody(body),
        clear(isWhole) {
            for (const body of world.bodies.getAll()) world.removeRigidBody(body);
            for (const collider of world.colliders.getAll()) world.removeCollider(collider, true);
            floor(isWhole);
        },
        sleep: body => body.sleep(), sensor(body, is) { for (let i = 0; i < body.numColliders(); ++i) body.collider(i).setSensor(is); },
        place(body, x) {
            body.setTranslation(at(x, height + radius), true);
            body.setRotation(unturned, true);
            body.setLinvel(at(0, 0), true);
            body.setAngvel(is3d ? at(0, 0) : 0, true);
        },
        step: haptics => haptics.step(seconds, () => { world.step(); for (const act of inStep.splice(0)) act(); }), within: act => inStep.push(act),
    };
}

for (const [name, make] of Object.entries(engines)) test(name, async () => {
    const engine = await make(), random = randomOf(Number(seed)), all = Array.from({ length: lanes }, (_, i) => ({ x: 1 + 1.5 * i, body: null, isSet: false, isSensor: false, isCompound: false }));
    let haptics = engine.attach(), felt = 0, silent = 0;
    const wrong = [], log = [];
    const leave = lane => Object.assign(lane, { body: null, isSet: false, isSensor: false });
    const acts = {
        make(lane) { if (!lane.body) { lane.isCompound = random(4) === 0; lane.body = engine.make(lane.x, lane.isCompound); } },
        set(lane) { if (lane.body) { lane.id = haptics.set(lane.isCompound && random(2) ? engine.partOf(lane.body) : lane.body, source); lane.isSet = true; } },
        unset(lane) { if (lane.body) { haptics.set(lane.body); lane.isSet = false; } },
        forget(lane) { if (lane.body) { haptics.remove(lane.body); lane.isSet = false; } },
        despawn(lane) { if (lane.body) { engine.remove(lane.body); leave(lane); } },
        remake(lane) { acts.despawn(lane); acts.make(lane); if (random(2)) acts.set(lane); },
        despawnWithin(lane) { engine.within(() => acts.despawn(lane)); engine.step(haptics); },
        late(lane) { if (lane.body) { const { body } = lane; acts.despawn(lane); if (!engine.pools) haptics.set(body, source); } }, // a body that has gone is set
        pool(lane) { if (lane.body && engine.pools) { engine.remove(lane.body); for (let i = random(3); i > 0; --i) engine.step(haptics); engine.add(lane.body); } },
        sleep(lane) { if (lane.body) engine.sleep(lane.body); },
        sensor(lane) { if (lane.body && !engine.hasNoSensors) { lane.isSensor = random(2) === 0; engine.sensor(lane.body, lane.isSensor); } },
        step() { engine.step(haptics); },
        clear() {
            if (random(8)) return;
            engine.clear(random(2) === 0);
            for (let i = random(3); i > 0; --i) engine.step(haptics);
            for (const lane of all) if (engine.pools && lane.body) engine.add(lane.body); else leave(lane);
        },
        free() {
            if (random(8)) return;
            haptics.free();
            engine.step(haptics); // a game's loop goes on
            haptics = engine.attach();
            for (const lane of all) lane.isSet = false;
        },
    };
    const names = Object.keys(acts);
    for (let life = 0; life < lives; life += lanes) {
        for (const lane of all) {
            acts.make(lane);
            if (random(3)) acts.set(lane);
            for (let i = random(6); i > 0; --i) {
                const act = names[random(names.length)];
                log.push(`${life} ${lane.x} ${act}`);
                acts[act](lane);
            }
        }
        for (const lane of all) if (lane.body) engine.place(lane.body, lane.x);
        engine.step(haptics); // touches of before end
        for (const lane of all) if (lane.body) engine.place(lane.body, lane.x);
        haptics.take(true);
        for (let i = 0; i < stepsOfFall; ++i) engine.step(haptics);
        const events = haptics.take(true);
        assert.equal(haptics.error, null, `${haptics.error?.stack} ${log.slice(-20)}`);
        for (const lane of all) {
            const isFelt = events.some(event => Math.abs(event.x - lane.x) < 0.5), isExpected = Boolean(lane.body) && lane.isSet && !lane.isSensor;
            if (isFelt !== isExpected || (isFelt && !events.some(event => event.fixture === lane.id))) wrong.push(`life ${life}, lane ${lane.x}: ${isFelt ? 'felt' : 'silent'}, ${JSON.stringify({ ...lane, body: Boolean(lane.body) })}; ${haptics.explain()}; ${log.filter(line => line.startsWith(`${life} `))}`);
            isFelt ? ++felt : ++silent;
        }
    }
    console.log(`${name}: ${lives} lives, ${felt} felt, ${silent} silent, ${wrong.length} wrong`);
    assert.deepEqual(wrong.slice(0, 3), []);
    haptics.free();
});
