// SPDX-License-Identifier: MIT
// Five worlds for each engine at three rates, against closed forms, the engine's own motion and native Box2D:
// worlds.mjs FOLDER [NATIVE [ENGINE...]]. FOLDER: where npm has installed physvib and the engines; NATIVE: the program
// physvib-engine-box2d, whose traces are left in FOLDER/native.json, where a browser finds them. Prints a table; exit code 1 if
// what is promised is missed.
import { load } from './installed.mjs';
import { engines } from './engines.mjs';
import { nativeTraces } from './native.mjs';

const g = 9.81, slope = 10 * Math.PI / 180, rates = [60, 240, 1000];
const [along, off] = [[Math.cos(slope), -Math.sin(slope)], [Math.sin(slope), Math.cos(slope)]];
const [folder, program, ...only] = process.argv.slice(2);
const physvib = await load(folder, 'physvib').then(library => library.load());

const floor = { id: 0, halfWidth: 5, halfHeight: 0.5, x: 0, y: -0.5, isStatic: true };
const box = (id, y) => ({ id, halfWidth: 0.1, halfHeight: 0.1, x: 0, y, massKg: 0.5 });
const ball = (id, x, y, massKg, vx = 0) => ({ id, radius: 0.1, x, y, massKg, vx });
const ramp = { ...floor, y: 0, angle: -slope };
const pole = { id: 1, halfWidth: 0.025, halfHeight: 0.5, x: 0, y: 0.5 * Math.cos(0.1) + 0.025 * Math.sin(0.1), angle: -0.1, massKg: 0.5 };
const worlds = {
    ball: { seconds: 2, restitution: 0.5, friction: 0.2, falls: true, bodies: [floor, ball(1, 0, 0.9, 0.2)] },
    stack: { seconds: 3, restitution: 0, friction: 0.6, falls: true, bodies: [floor, box(1, 0.4), box(2, 0.7), box(3, 1)] },
    row: { seconds: 0.5, restitution: 0, friction: 0, gravity: 0,
        bodies: [0, 1, 2, 3, 4].map(i => ball(i + 1, i === 0 ? -0.06 : 0.19999 * i, 0, 1, i === 0 ? 3 : 0)) },
    pole: { seconds: 4, restitution: 0, friction: 0.8, bodies: [floor, pole] },
    slope: { seconds: 2, restitution: 0, friction: 0.6, grain: 0.01,
        bodies: [ramp, ball(1, -3 * along[0] + 0.6 * off[0], -3 * along[1] + 0.6 * off[1], 0.2)] },
};
for (const world of Object.values(worlds)) world.gravity ??= g;
const native = await nativeTraces(folder, program, worlds, rates);

const percent = share => `${share >= 0 ? '+' : ''}${(100 * share).toFixed(1)} %`;
const bad = [];
const demand = (holds, where, what) => { if (!holds) bad.push(`${where}: ${what}`); return holds ? '' : ' MISSED'; };

/** What an engine does: its events, motions of body 1 after each step, and of the last body. */
async function run(name, kind, hz) {
    const world = worlds[kind], told = native[`${kind}/${hz}`];
    if (name === 'native') return { ...told, hits: hitsOf(told.events), engine: { isWhole: true, movesFirst: true }, world };
    const engine = await engines[name](folder, physvib, world, hz), { haptics } = engine;
    for (const body of world.bodies) {
        haptics.set(engine.bodies.get(body.id), body.isStatic ? { frequencyHz: 200, decayPerSecond: 30, grain: world.grain ?? 0 }
            : { isSource: true, frequencyHz: 200, decayPerSecond: 30, ...(world.grain ? { voice: 'other' } : {}) });
    }
    const last = world.bodies.at(-1).id, motions = [engine.motion(1)], lasts = [engine.motion(last)];
    for (let step = 0; step < world.seconds * hz; ++step) {
        engine.step(1 / hz);
        motions.push(engine.motion(1));
        lasts.push(engine.motion(last));
    }
    const numbers = new Map(world.bodies.map(body => [haptics.id(engine.bodies.get(body.id)), body.id]));
    const events = haptics.take(true).map(event => ({ ...event, seconds: event.timeNs * 1e-9, fixture: numbers.get(event.fixture),
        other: numbers.get(event.other) }));
    haptics.free();
    return { events, hits: hitsOf(events), motions, lasts, engine, world };
}
const hitsOf = events => events.filter(event => event.kind === 'hit');
const strongest = hits => [...hits].sort((a, b) => b.impulse - a.impulse)[0];

/** The hit that a world is about. */
const chosen = {
    ball: ({ hits }) => hits[0],
    stack: ({ hits }) => strongest(hits.filter(hit => hit.fixture === 1 && hit.other === 0 && hit.seconds < 0.35)),
    row: ({ hits }) => hits.find(hit => hit.fixture === 5),
    pole({ hits, motions }, hz) {
        const spins = motions.map(({ spin }) => Math.abs(spin)), drops = spins.slice(1).map((spin, i) => spins[i] - spin);
        const landed = (drops.indexOf(Math.max(...drops)) + 0.5) / hz;
        return strongest(hits.filter(hit => Math.abs(hit.seconds - landed) < Math.max(0.03, 6 / hz)));
    },
};

const judge = {
    ball(run, where, hz) {
        const { hits, motions, engine } = run, due = Math.sqrt(2 * 0.8 / g), paper = 0.2 * g * due * 1.5, first = chosen.ball(run);
        if (!first) return `nothing felt${demand(false, where, 'a hit')}`;
        const k = Math.round(due * hz), speeds = motions.map(({ vy }) => vy);
        const near = Math.min(...speeds.slice(Math.max(0, k - 3), k + 5)), up = Math.max(...speeds.slice(k - 3, k + 6));
        const own = 0.2 * (up - near + (engine.movesFirst ? g / hz : 0));
        const onset = (first.seconds - due) * hz, ofPaper = first.impulse / paper - 1, ofOwn = first.impulse / own - 1;
        const missed = demand(Math.abs(onset) <= 0.25, where, `onset ${onset.toFixed(2)} steps`) + (engine.tellsImpulses
            ? demand(Math.abs(ofPaper) <= 0.03, where, `impulse ${percent(ofPaper)}`)
            : demand(Math.abs(ofOwn) <= 0.03, where, `impulse ${percent(ofOwn)} of the engine's own`));
        return `${hits.length} hits; onset ${onset.toFixed(2)} steps; impulse ${percent(ofPaper)} of paper, ${percent(ofOwn)} of the engine's own${missed}`;
    },
    stack({ hits, engine, world }, where, hz) {
        const landings = [[1, 0, 0.3], [2, 1, 0.4], [3, 2, 0.5]].map(([fixture, other, gap]) => {
            const due = Math.sqrt(2 * gap / g), isIt = hit => hit.fixture === fixture && hit.other === other;
            const hit = strongest(hits.filter(hit => isIt(hit) && Math.abs(hit.seconds - due) < 0.05));
            return hit ? `${fixture}: ${((hit.seconds - due) * hz).toFixed(2)} steps, ${percent(hit.impulse / (0.5 * g * due) - 1)}` : `${fixture}: none`;
        });
        const late = hits.filter(event => event.seconds > world.seconds - 1).length, isFine = late === 0 && !landings.join().includes('none');
        const missed = engine.isWhole ? demand(isFine, where, 'three landings, then rest') : '';
        return `${hits.length} hits; ${landings.join('; ')}; in the last second ${late}${missed}`;
    },
    row(run, where) {
        const { hits, lasts, engine } = run, own = Math.max(...lasts.map(({ vx }) => vx)), hit = chosen.row(run);
        const missed = (holds, what) => (engine.isWhole ? demand(holds, where, what) : '');
        if (!hit) return `not felt; the last goes with ${own.toFixed(2)} m/s${missed(false, 'the last of the row')}`;
        const count = hits.filter(event => event.fixture === 5).length, off = hit.impulse / own - 1;
        return `the last: ${count} hits, the first ${percent(off)} of its own ${own.toFixed(2)} N s${missed(Math.abs(off) <= 0.15, `${hit.impulse} N s`)}`;
    },
    pole(run, where, hz) {
        const { hits, motions } = run, spin = Math.max(...motions.map(motion => Math.abs(motion.spin))), head = chosen.pole(run, hz);
        return head ? `head ${head.impulse.toFixed(2)} of ${(0.5 / 3 * spin).toFixed(2)} N s (m/3 of its speed); ${hits.length} hits` : `not felt; ${hits.length} hits`;
    },
    slope({ events, hits, motions, engine }, where) {
        const grains = events.filter(event => event.kind !== 'hit'), due = (2 / 3 * g * Math.sin(slope) * 4 / 2) / 0.01;
        const passed = (motions.at(-1).x - motions[0].x) / Math.cos(slope) / 0.01;
        const missed = engine.isWhole ? demand(Math.abs(grains.length / passed - 1) <= 0.05, where, `${grains.length} grains`) : '';
        return `${grains.length} grains of ${passed.toFixed(0)} passed (${due.toFixed(0)} by pencil), ${hits.length} hits${missed}`;
    },
};

/** The same hit, or the grains, in native Box2D. */
async function besideNative(found, kind, hz) {
    if (native[`${kind}/${hz}`] === undefined) return '';
    const there = await run('native', kind, hz);
    if (kind === 'slope') return `; native ${there.events.length - there.hits.length} grains`;
    const [here, wanted] = [found, there].map(run => chosen[kind](run, hz));
    if (!here || !wanted) return `; native ${wanted ? 'felt' : 'not felt'}`;
    return `; from native ${(1000 * (here.seconds - wanted.seconds)).toFixed(2)} ms, ${percent(here.impulse / wanted.impulse - 1)}`;
}

const names = only.length > 0 ? only : [...(Object.keys(native).length > 0 ? ['native'] : []), ...Object.keys(engines)];
for (const name of names) {
    for (const kind of Object.keys(worlds)) for (const hz of rates) {
        const where = `${name}, ${kind}, ${hz}/s`, found = await run(name, kind, hz);
        console.log(`${where}: ${judge[kind](found, where, hz)}${name === 'native' ? '' : await besideNative(found, kind, hz)}`);
    }
}
if (bad.length > 0) console.log(`MISSED:\n${bad.join('\n')}`);
process.exit(bad.length > 0 ? 1 : 0);
