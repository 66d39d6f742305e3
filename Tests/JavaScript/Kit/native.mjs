// SPDX-License-Identifier: MIT
// The kit in an engine of another language: a program (../../Engines/Kit.h says how it is talked to) that runs once for each situation.
import { execFileSync, spawn } from 'node:child_process';
import { mkdtempSync, openSync, closeSync, readSync, rmSync, writeSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const types = ['fixed', 'kinematic', 'dynamic'], traits = { chipmunk: { halfStep: -1 }, pymunk: { halfStep: -1 }, ode: { pushesApart: true }, bullet: { pushesApart: true }, box2d3: { halfStep: 1 / 4 }, box3d: { halfStep: 1 / 4 }, mujoco: { pushesApart: true, halfSeconds: 0.002, isClosed: true, hasNoKinematic: true } };

/** A driver as those of drivers.mjs, of a command; both pipes wait, as a step's answer is needed before the next. */
export const native = (name, command) => async (_, __, { gravity }) => {
    const own = traits[name.split('@')[0]]; // NAME@VERSION
    const folder = mkdtempSync(join(tmpdir(), 'physvib-kit-')), [asks, answers] = ['asks', 'answers'].map(end => join(folder, end)), [program, ...words] = command.split(' ');
    execFileSync('mkfifo', [asks, answers]);
    const child = spawn('sh', ['-c', 'exec "$@" <"$0/asks" >"$0/answers"', folder, program, ...words], { stdio: ['ignore', 'ignore', 'inherit'] });
    const to = openSync(asks, 'w'), from = openSync(answers, 'r'), bytes = Buffer.alloc(1 << 16);
    let rest = '';
    const say = (...told) => writeSync(to, `${told.join(' ')}\n`), line = () => {
        for (let end; (end = rest.indexOf('\n')) < 0;) {
            const count = readSync(from, bytes);
            if (count === 0) throw new Error(`${command}: ended`);
            rest += bytes.toString('utf8', 0, count);
        }
        const end = rest.indexOf('\n'), told = rest.slice(0, end);
        rest = rest.slice(end + 1);
        return told.startsWith('> ') ? told.slice(2) : line(); // Chipmunk says who it is
    };
    const verbs = line().split(' '), kilograms = new Map(), kinds = new Map(), fixtures = new Map(), pace = 1 / 60, numbers = told => told.trim().split(' ').map(Number), live = body => { if (!kinds.has(body)) throw new Error('gone'); return body; };
    let bodies = 0, isBegun = false;
    const driver = {
        ...own, halfStep: own?.halfStep ?? 1, isSingle: true, count: () => kinds.size,
        attach: () => ({
            set(body) { say('feel', body); return body; },
            take() { say('take'); const all = line().trim(), told = all === '' ? [] : numbers(all); return Array.from({ length: told.length / 4 }, (_, i) => ({ timeNs: told[4 * i], fixture: told[4 * i + 1], impulse: told[4 * i + 2], kind: told[4 * i + 3] === 0 ? 'hit' : 'lasting' })); },
            explain() { say('explain'); return line(); }, free() {}, error: null,
        }),
        create(of) {
            if (!isBegun) say('world', gravity, of.restitution ?? 0, of.friction ?? 0.3, 1 / pace);
            isBegun = true;
            const id = ++bodies, type = of.type ?? 'dynamic', [width, height] = of.radius ? [2 * of.radius, 2 * of.radius] : of.half.map(length => 2 * length);
            say('body', id, of.radius ? 0 : 1, of.x, of.y, of.angle ?? 0, width, height, of.massKg ?? 0, of.vx ?? 0, of.vy ?? 0, of.spin ?? 0, types.indexOf(type), of.lockTurn ? 1 : 0, of.sensor ? 1 : 0, of.bullet ? 1 : 0);
            kilograms.set(id, of.massKg ?? 0);
            kinds.set(id, type);
            return id;
        },
        get(body) {
            say('get', live(body));
            const [x, y, vx, vy, angle, spin] = numbers(line());
            return { x, y, vx, vy, angle, spin, massKg: kinds.get(body) === 'dynamic' ? kilograms.get(body) : 0 };
        },
        step: seconds => say('step', seconds), pin: (a, b, x, y) => say('pin', a, b, x, y),
        end() { closeSync(to); closeSync(from); rmSync(folder, { recursive: true }); child.unref(); },
    };
    const act = (verb, body = 0, x = 0, y = 0, z = 0) => say(verb, body, x, y, z), acts = {
        type(body, type) { kinds.set(body, type); act('type', body, types.indexOf(type)); }, mass(body, kg) { kilograms.set(body, kg); act('mass', body, kg); },
        remove(body) { act('remove', live(body)); kinds.delete(body); }, gravity: y => act('gravity', 0, y),
        passes: (body, is) => act('passes', body, is ? 1 : 0), sensor: (body, is) => act('sensor', body, is ? 1 : 0), enable: (body, is) => act('enable', body, is ? 1 : 0),
    };
    for (const verb of verbs) driver[verb] = acts[verb] ?? ((...told) => act(verb, ...told));
    if (driver.moves) driver.moveTo = (body, x, y, seconds) => { const at = driver.get(body); driver.moves(body, (x - at.x) / seconds, (y - at.y) / seconds); };
    return driver;
};
