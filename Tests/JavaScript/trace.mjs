// SPDX-License-Identifier: MIT
// A world as text (Tests/Engines/Trace.h), through an engine's attachment: its motion and its events, as text.
// trace.mjs FOLDER ENGINE WORLD.txt... writes WORLD.txt.trace. FOLDER: where npm has installed physvib and the engines.
import { engines, fieldCorner } from './engines.mjs';
import { load } from './installed.mjs';

const floorBody = 100;
const gravity = 9.81;

const readers = {
    world: (world, hz, restitution, friction, seconds) => Object.assign(world, { hz, restitution, friction, seconds }),
    falling: world => { world.isFalling = true; },
    starting: (world, ...accelerations) => { world.starting = accelerations; },
    floor: world => world.bodies.push({ id: floorBody, halfWidth: 20, halfHeight: 0.5, x: 0, y: -0.5, isStatic: true }),
    tiles: (world, left, right, count) => { world.tiles = { id: floorBody, left, right, count }; },
    pin: (world, a, b, x, y) => world.pins.push({ a, b: b > 0 ? b : null, x, y }),
    oneway: (world, id) => { world.oneWay = id; },
    ball: (...values) => addBody(false, ...values),
    box: (...values) => addBody(true, ...values),
};
function addBody(isBox, world, id, x, y, angle, width, height, massKg, ...rest) {
    const [ax, ay, turn] = world.starting, late = massKg > 0 ? 0.5 / world.hz : 0, isSource = rest[3] === 1; // as Trace.h
    const [vx, vy, spin] = [rest[0] - late * ax, rest[1] - late * ay, rest[2] - late * turn];
    const shape = isBox ? { halfWidth: width / 2, halfHeight: height / 2 } : { radius: width / 2 };
    world.bodies.push({ id, ...shape, x, y, angle, massKg, vx, vy, spin, isStatic: massKg === 0, isSource, falls: world.isFalling });
}

/** A world for engines.mjs. */
export function worldOf(text) {
    const world = { gravity, bodies: [], pins: [], isFalling: false, starting: [0, 0, 0] };
    for (const line of text.trim().split('\n')) {
        const [word, ...numbers] = line.split(' ');
        if (readers[word] === undefined) throw new Error(`expected ${Object.keys(readers).join(', ')}, found ${word}`);
        readers[word](world, ...numbers.map(Number));
    }
    return world;
}

/** The same for a program of Tests/Engines. */
export function textOf(world, hz) {
    const lines = [`world ${hz} ${world.restitution} ${world.friction} ${world.seconds}`];
    if (world.gravity === 0) lines.unshift('weightless');
    if (world.grain) lines.push(`grain ${world.grain}`);
    if (world.falls) lines.push('falling');
    for (const body of world.bodies) {
        const { id, x, y, angle = 0, radius, halfWidth = radius, halfHeight = radius, massKg = 0, vx = 0, vy = 0, spin = 0 } = body;
        const size = [2 * halfWidth, 2 * halfHeight, massKg], motion = [vx, vy, spin, massKg > 0 ? 1 : 0];
        lines.push([radius ? 'ball' : 'box', id, x, y, angle, ...size, ...motion].join(' '));
    }
    return `${lines.join('\n')}\n`;
}

/** `m` and `e` lines. */
export async function trace(folder, physvib, name, text) {
    const world = worldOf(text), { hz } = world, { haptics, bodies, motion, step } = await engines[name](folder, physvib, world, hz);
    for (const { id, isSource } of [...world.bodies, ...(world.tiles ? [{ id: floorBody }] : [])])
        haptics.set(bodies.get(id), { isSource: isSource ?? false, frequencyHz: 200, decayPerSecond: 30 });
    const numbers = new Map([...bodies].map(([id, body]) => [haptics.id(body), id])), lines = [];
    const print = n => {
        for (const { id } of world.bodies.filter(body => !body.isStatic)) {
            const { x, y, vx, vy, spin, angle } = motion(id);
            lines.push(`m ${n} ${id} ${x} ${y} ${vx} ${vy} ${spin} ${angle}`);
        }
    };
    print(0);
    for (let n = 1; n <= Math.floor(hz * world.seconds); ++n) {
        step(1 / hz);
        print(n);
    }
    for (const { timeNs, fixture, other, impulse, x, y } of haptics.take(true))
        lines.push(`e ${timeNs * 1e-9} ${numbers.get(fixture)} ${numbers.get(other) ?? floorBody} ${impulse} ${x + fieldCorner.x} ${y + fieldCorner.y}`);
    haptics.free();
    return lines.join('\n');
}

if (globalThis.process?.argv[1]?.endsWith('trace.mjs')) {
    const [folder, name, ...paths] = process.argv.slice(2), { readFileSync, writeFileSync } = await import('node:fs');
    const physvib = await (await load(folder, 'physvib')).load();
    for (const path of paths) writeFileSync(`${path}.trace`, await trace(folder, physvib, name, readFileSync(path, 'utf8')));
    process.exit(0);
}
