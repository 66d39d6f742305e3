// SPDX-License-Identifier: MIT
// A ball without gravity in a box that is turned somehow in space, through Rapier 3D's attachment, as Tests/Engines/TurnedBrick.h has it for others:
// what is felt against the engine's own motion, and the first hit of each axis against the closed form: space.mjs FOLDER. Then a ball that rolls and
// one that slides down an incline: what grains they pass.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load();
const { default: R } = await load(folder, '@dimforge/rapier3d-compat'), { attach } = await load(folder, 'physvib/rapier3d');
await R.init();
const rate = 240, radius = 0.05, massKg = 0.7, restitution = 0.8, half = [0.5, 0.4, 0.3], seconds = 3;
const start = [0.12, -0.05, 0.07], speed = [1.9, -1.3, 0.8], axes = ['x', 'y', 'z'];
const vector = ([x, y, z]) => ({ x, y, z }), dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];

/** Three axes, turned about z, then x, then y. */
function turned(angles) {
    const box = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
    [[0, 1], [1, 2], [2, 0]].forEach(([a, b], k) => box.forEach(v => {
        const [p, q] = [v[a], v[b]], c = Math.cos(angles[k]), s = Math.sin(angles[k]);
        [v[a], v[b]] = [c * p - s * q, s * p + c * q];
    }));
    return { toWorld: v => [0, 1, 2].map(k => v[0] * box[0][k] + v[1] * box[1][k] + v[2] * box[2][k]), toBox: v => box.map(axis => dot(v, axis)), box };
}
function hitOf(axis, at, v) {
    const isUp = v[axis] > 0, gap = half[axis] - radius - (isUp ? at[axis] : -at[axis]), way = Math.abs(v[axis]);
    const place = at.map((x, k) => (k === axis ? (isUp ? half[axis] : -half[axis]) : x + v[k] * gap / way));
    return { wall: 2 * axis + (isUp ? 1 : 0), seconds: gap / way, impulse: massKg * way * (1 + restitution), place };
}
/** The quaternion whose columns are these axes. */
function rotationOf([a, b, c]) {
    const w = Math.sqrt(Math.max(0, 1 + a[0] + b[1] + c[2])) / 2, sign = (x, of) => Math.sign(of) * x;
    return { w, x: sign(Math.sqrt(Math.max(0, 1 + a[0] - b[1] - c[2])) / 2, b[2] - c[1]), y: sign(Math.sqrt(Math.max(0, 1 - a[0] + b[1] - c[2])) / 2, c[0] - a[2]),
        z: sign(Math.sqrt(Math.max(0, 1 - a[0] - b[1] + c[2])) / 2, a[1] - b[0]) };
}

function play(angles) {
    const { toWorld, toBox, box } = turned(angles), world = new R.World(vector([0, 0, 0])), turn = rotationOf(box), ids = [];
    const haptics = attach(physvib, world, { normalisation: 1, handMassKg: 0 });
    for (let wall = 0; wall < 6; ++wall) {
        const axis = Math.floor(wall / 2), thick = 1, place = [0, 0, 0], size = half.map(h => h + 2 * thick);
        place[axis] = (wall % 2 ? 1 : -1) * (half[axis] + thick);
        size[axis] = thick;
        const body = world.createRigidBody(R.RigidBodyDesc.fixed().setTranslation(...toWorld(place)).setRotation(turn));
        world.createCollider(R.ColliderDesc.cuboid(...size).setRestitution(restitution).setFriction(0), body);
        ids.push(haptics.set(body, {}));
    }
    const ball = world.createRigidBody(R.RigidBodyDesc.dynamic().setTranslation(...toWorld(start)).setLinvel(...toWorld(speed)).setCanSleep(false));
    world.createCollider(R.ColliderDesc.ball(radius).setMass(massKg).setRestitution(restitution).setFriction(0), ball);
    haptics.set(ball, { isSource: true, frequencyHz: 200, decayPerSecond: 30 });
    const hits = [], list = v => axes.map(axis => v[axis]);
    for (let step = 0; step < seconds * rate; ++step) {
        const at = toBox(list(ball.translation())), v = toBox(list(ball.linvel()));
        haptics.update(1 / rate);
        const after = toBox(list(ball.linvel())); // it turns before it touches, where it would touch a little later
        for (let axis = 0; axis < 3; ++axis) {
            if (v[axis] * after[axis] > 0) continue;
            const hit = hitOf(axis, at, v);
            hits.push({ ...hit, seconds: hit.seconds + step / rate, place: toWorld(hit.place), isFirst: !hits.some(({ wall }) => wall >> 1 === axis), axis });
        }
    }
    for (let k = 0; k < 3; ++k) haptics.update(1 / rate);
    const events = haptics.take(true).filter(({ timeNs }) => Number(timeNs) * 1e-9 < seconds);
    haptics.free();
    world.free();
    return { hits: hits.map(hit => ({ ...hit, id: ids[hit.wall] })), events };
}

test('a tilted box', () => {
    for (const [index, angles] of [[0, 0, 0], [0.5, 0, 0], [0, Math.PI / 2, 0], [0.4, 1.1, -0.7], [-2.1, 0.3, 2.9], [1, -2.2, 0.6]].entries()) {
        const { hits, events } = play(angles), own = { ms: 0, part: 0, mm: 0 }, paper = { ms: 0, part: 0 };
        let felt = 0;
        for (const hit of hits) {
            const event = events.find(({ other, timeNs }) => other === hit.id && Math.abs(Number(timeNs) * 1e-9 - hit.seconds) < 0.01);
            if (event === undefined) continue;
            ++felt;
            const off = (to, of) => {
                to.ms = Math.max(to.ms, Math.abs(Number(event.timeNs) * 1e-6 - of.seconds * 1e3));
                to.part = Math.max(to.part, Math.abs(event.impulse / of.impulse - 1));
            };
            off(own, hit);
            own.mm = Math.max(own.mm, 1e3 * Math.hypot(event.x - hit.place[0], event.y - hit.place[1], event.z - hit.place[2]));
            if (hit.isFirst) off(paper, hitOf(hit.axis, start, speed));
        }
        console.log(`| Rapier 3D | ${index} | ${felt} of ${hits.length}, ${events.length} events | ${own.ms.toFixed(4)} ms, ${(100 * own.part).toFixed(4)} %, ${own.mm.toFixed(2)} mm | ${paper.ms.toFixed(4)} ms, ${(100 * paper.part).toFixed(4)} % |`);
        assert.ok(hits.length >= 10 && felt === hits.length && events.length === hits.length);
        assert.ok(own.ms < 0.1 && own.part < 0.02 && own.mm < 10 && paper.ms < 0.1 && paper.part < 0.02);
    }
});

test('what slides passes more grains than what rolls', () => {
    const grainsOf = friction => {
        const world = new R.World(vector([0, -9.81, 0])), haptics = attach(physvib, world, { fieldWidth: 4, fieldX: -2, fieldY: -2 });
        const ground = world.createRigidBody(R.RigidBodyDesc.fixed().setTranslation(0, -0.5, 0));
        world.createCollider(R.ColliderDesc.cuboid(5, 0.5, 5).setFriction(friction), ground);
        haptics.set(ground, { frequencyHz: 300, decayPerSecond: 60, grain: 0.01 });
        const ball = world.createRigidBody(R.RigidBodyDesc.dynamic().setTranslation(0, 0.1, 0).setLinvel(0.6, 0, 0.8).setAngvel(vector(friction ? [8, 0, -6] : [0, 0, 0])).setCanSleep(false));
        world.createCollider(R.ColliderDesc.ball(0.1).setMass(0.5).setFriction(friction), ball);
        haptics.set(ball, { isSource: true, voice: 'other' });
        for (let k = 0; k < rate; ++k) haptics.update(1 / rate);
        const grains = haptics.take(true).filter(({ kind }) => kind !== 'hit');
        haptics.free();
        world.free();
        return grains;
    };
    const rolls = grainsOf(1), slides = grainsOf(0);
    for (const grains of [rolls, slides]) assert.ok(Math.abs(grains.length - 100) < 12, `${grains.length} grains in 1 m`);
    assert.ok(rolls.every(({ kind }) => kind === 'roll') && slides.every(({ kind }) => kind === 'slide'));
    assert.ok(slides.at(-1).z > 0.7 && slides.at(-1).x > 0.5, 'where it is');
});
