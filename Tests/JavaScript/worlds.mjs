// SPDX-License-Identifier: MIT
// Five worlds for each engine at three rates, against closed forms and the engine's own motion: worlds.mjs FOLDER [ENGINE...].
// FOLDER: where npm has installed physvib and the engines. Prints a table; exit code 1 if what is promised is missed.
import { load } from './installed.mjs';
import { engines } from './engines.mjs';

const g = 9.81, slope = 10 * Math.PI / 180, [along, off] = [[Math.cos(slope), -Math.sin(slope)], [Math.sin(slope), Math.cos(slope)]];
const [folder, ...only] = process.argv.slice(2);
const physvib = await load(folder, 'physvib').then(library => library.load());

const floor = { id: 0, halfWidth: 5, halfHeight: 0.5, x: 0, y: -0.5, isStatic: true };
const box = (id, y) => ({ id, halfWidth: 0.1, halfHeight: 0.1, x: 0, y, massKg: 0.5 });
const worlds = {
    ball: { seconds: 2, restitution: 0.5, friction: 0.2, falls: true, bodies: [floor, { id: 1, radius: 0.1, x: 0, y: 0.9, massKg: 0.2 }] },
    stack: { seconds: 3, restitution: 0, friction: 0.6, falls: true, bodies: [floor, box(1, 0.4), box(2, 0.7), box(3, 1)] },
    row: { seconds: 0.5, restitution: 0, friction: 0, gravity: 0, bodies: [0, 1, 2, 3, 4].map(i => ({ id: i + 1, radius: 0.1, x: i === 0 ? -0.06 : 0.19999 * i, y: 0, massKg: 1, vx: i === 0 ? 3 : 0 })) },
    pole: { seconds: 4, restitution: 0, friction: 0.8, bodies: [floor, { id: 1, halfWidth: 0.025, halfHeight: 0.5, x: 0, y: 0.5 * Math.cos(0.1) + 0.025 * Math.sin(0.1), angle: -0.1, massKg: 0.5 }] },
    slope: { seconds: 2, restitution: 0, friction: 0.6, grain: 0.01, bodies: [{ ...floor, y: 0, angle: -slope }, { id: 1, radius: 0.1, x: -3 * along[0] + 0.6 * off[0], y: -3 * along[1] + 0.6 * off[1], massKg: 0.2 }] },
};
for (const world of Object.values(worlds)) world.gravity ??= g;

const inertiaOf = body => (body.radius ? body.massKg * body.radius ** 2 / 2 : body.massKg * (4 * body.halfWidth ** 2 + 4 * body.halfHeight ** 2) / 12);
const percent = share => `${share >= 0 ? '+' : ''}${(100 * share).toFixed(1)} %`;
const bad = [];
const demand = (holds, where, what) => { if (!holds) bad.push(`${where}: ${what}`); return holds ? '' : ' MISSED'; };

async function run(name, kind, hz) {
    const world = worlds[kind], engine = await engines[name](folder, physvib, world, hz, { inertiaOf });
    const { haptics } = engine;
    for (const body of world.bodies) {
        haptics.set(engine.bodies.get(body.id), body.isStatic ? { frequencyHz: 200, decayPerSecond: 30, grain: world.grain ?? 0 }
            : { isSource: true, frequencyHz: 200, decayPerSecond: 30, ...(world.grain ? { voice: 'other' } : {}) });
    }
    const speeds = [engine.velocity(1)], angles = [engine.angle(1)], last = [], xs = [engine.x(1)];
    for (let step = 0; step < world.seconds * hz; ++step) {
        engine.step(1 / hz);
        speeds.push(engine.velocity(1));
        angles.push(engine.angle(1));
        xs.push(engine.x(1));
        if (kind === 'row') last.push(engine.velocityX(5));
    }
    const events = haptics.take(true).map(event => ({ ...event, seconds: event.timeNs * 1e-9 }));
    const numbers = new Map(world.bodies.map(body => [haptics.id(engine.bodies.get(body.id)), body.id]));
    for (const event of events) [event.fixture, event.other] = [numbers.get(event.fixture), numbers.get(event.other)];
    haptics.free();
    return { events, hits: events.filter(event => event.kind === 'hit'), speeds, angles, xs, last, engine, world };
}

const judge = {
    ball({ hits, speeds, engine }, where, hz) {
        const due = Math.sqrt(2 * (0.8 - (engine.skin ?? 0)) / g), speed = g * due, paper = 0.2 * speed * 1.5, [first] = hits;
        if (!first) return `nothing felt${demand(false, where, 'a hit')}`;
        const k = Math.round(due * hz), near = Math.min(...speeds.slice(Math.max(0, k - 3), k + 5)), up = Math.max(...speeds.slice(k - 3, k + 6)), own = 0.2 * (up - near + (engine.movesFirst ? g / hz : 0));
        const onset = (first.seconds - due) * hz, ofPaper = first.impulse / paper - 1, ofOwn = first.impulse / own - 1, isExact = engine.tellsImpulses;
        const missed = demand(Math.abs(onset) <= 0.25, where, `onset ${onset.toFixed(2)} steps`) + (isExact ? demand(Math.abs(ofPaper) <= 0.03, where, `impulse ${percent(ofPaper)}`)
            : demand(Math.abs(ofOwn) <= 0.03, where, `impulse ${percent(ofOwn)} of the engine's own`));
        return `${hits.length} hits; onset ${onset.toFixed(2)} steps; impulse ${percent(ofPaper)} of paper, ${percent(ofOwn)} of the engine's own${missed}`;
    },
    stack({ hits, engine, world }, where, hz) {
        const landings = [[1, 0, 0.3], [2, 1, 0.4], [3, 2, 0.5]].map(([fixture, other, gap]) => {
            const due = Math.sqrt(2 * (gap - 2 * fixture * (engine.skin ?? 0)) / g);
            const hit = hits.filter(event => event.fixture === fixture && event.other === other && Math.abs(event.seconds - due) < 0.05).sort((a, b) => b.impulse - a.impulse)[0];
            return hit ? `${fixture}: ${((hit.seconds - due) * hz).toFixed(2)} steps, ${percent(hit.impulse / (0.5 * g * due) - 1)}` : `${fixture}: none`;
        });
        const late = hits.filter(event => event.seconds > world.seconds - 1).length;
        return `${hits.length} hits; ${landings.join('; ')}; in the last second ${late}${engine.isWhole ? demand(late === 0 && !landings.join().includes('none'), where, 'three landings, then rest') : ''}`;
    },
    row({ hits, last, engine }, where) {
        const own = Math.max(...last), felt = hits.filter(event => event.fixture === 5), [hit] = felt;
        if (!hit) return `not felt; the last goes with ${own.toFixed(2)} m/s${engine.isWhole ? demand(false, where, 'the last of the row') : ''}`;
        return `the last: ${felt.length} hits, the first ${percent(hit.impulse / own - 1)} of its own ${own.toFixed(2)} N s${engine.isWhole ? demand(Math.abs(hit.impulse / own - 1) <= 0.15, where, `${hit.impulse} N s`) : ''}`;
    },
    pole({ hits, angles }, where, hz) {
        const flat = -Math.PI / 2 + 0.004, k = angles.findIndex(angle => angle < flat), landed = k < 0 ? NaN : k / hz, spin = Math.max(...angles.slice(1).map((angle, i) => Math.abs(angle - angles[i]) * hz));
        const head = hits.filter(event => Math.abs(event.seconds - landed) < Math.max(0.03, 6 / hz)).sort((a, b) => b.impulse - a.impulse)[0];
        return head ? `head ${head.impulse.toFixed(2)} of ${(0.5 / 3 * spin).toFixed(2)} N s (m/3 of its speed), ${((head.seconds - landed) * hz).toFixed(1)} steps; ${hits.length} hits` : `not felt; ${hits.length} hits`;
    },
    slope({ events, hits, xs, engine }, where) {
        const grains = events.filter(event => event.kind !== 'hit'), passed = (xs.at(-1) - xs[0]) / Math.cos(slope) / 0.01, due = (2 / 3 * g * Math.sin(slope) * 4 / 2) / 0.01;
        return `${grains.length} grains of ${passed.toFixed(0)} passed (${due.toFixed(0)} by pencil), ${hits.length} hits${engine.isWhole ? demand(Math.abs(grains.length / passed - 1) <= 0.05, where, `${grains.length} grains`) : ''}`;
    },
};

for (const name of only.length > 0 ? only : Object.keys(engines)) {
    for (const kind of Object.keys(worlds)) for (const hz of [60, 240, 1000]) {
        const where = `${name}, ${kind}, ${hz}/s`;
        console.log(`${where}: ${judge[kind](await run(name, kind, hz), where, hz)}`);
    }
}
if (bad.length > 0) console.log(`MISSED:\n${bad.join('\n')}`);
process.exit(bad.length > 0 ? 1 : 0);
