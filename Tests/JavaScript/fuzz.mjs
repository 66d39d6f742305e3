// SPDX-License-Identifier: MIT
// Balls that are made, put, thrown, made heavier, let float, removed, at random, in each engine of the kit: fuzz.mjs FOLDER [SEEDS [ENGINE...]]. Each blow that the engine's
// own velocities show, 3 times the threshold and more, of a ball that did not touch in the step before: how many are felt, and how many of them 1.35 times as strong.
import { load } from './installed.mjs';
import { drivers } from './Kit/drivers.mjs';

const [folder, seeds = '20', ...names] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load(), source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 };
const g = 9.81, seconds = 1 / 60, radius = 0.1, threshold = 1.5 * g * seconds, steps = 240, nearMetres = 0.006;
function randomOf(state) {
    return count => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return Math.floor(state / 2 ** 32 * count);
    };
}

async function play(make, seed) {
    const engine = await make(folder, physvib, { gravity: g }), haptics = engine.attach(), random = randomOf(seed * 7919), blows = [];
    let balls = [];
    engine.create({ type: 'fixed', x: 0, y: -0.5, half: [30, 0.5], restitution: 0.3 });
    const add = () => {
        const x = random(19) - 9;
        if (balls.some(ball => Math.abs(ball.x - x) < 0.5)) return;
        const body = engine.create({ radius, massKg: 0.2 + 0.1 * random(5), x, y: 0.3 + 0.1 * random(20), restitution: 0.1 * random(5) });
        balls.push({ body, x, id: haptics.set(body, source), scale: 1, gap: 1, lastGap: 1 });
    };
    const put = ({ body, x }, y, vy) => { engine.put(body, x, y); engine.fling(body, 0, vy); };
    const acts = [ball => put(ball, 0.3 + 0.1 * random(15), 0), ({ body }) => engine.fling(body, 0, random(5) - 2), ({ body }) => engine.mass(body, 0.1 + 0.1 * random(9)),
        ball => { engine.remove(ball.body); balls = balls.filter(other => other !== ball); }, ({ body }) => haptics.set(body, source),
        ball => { ball.scale = 0.5 * random(3) + 0.5; engine.gravityScale?.(ball.body, ball.scale); if (!engine.gravityScale) ball.scale = 1; },
        ball => put(ball, radius - 0.01 * random(3), -random(4))];
    for (let k = 0; k <= steps; ++k) { // the last one for the rest of a bounce alone
        if (k === 0 || (k < steps && random(6) === 0)) add();
        if (k < steps && balls.length > 0 && random(4) === 0) {
            const act = acts[random(acts.length)], ball = balls[random(balls.length)];
            if (ball.blow?.k === k - 1) ball.blow.isDisturbed = true; // the rest of a bounce, of engines that take two steps for it, may be lost
            act(ball);
        }
        for (const ball of balls) ball.before = engine.get(ball.body);
        engine.step(seconds, haptics);
        for (const ball of balls) {
            const { vy, massKg, y } = engine.get(ball.body), { before } = ball, change = vy - before.vy, newtonSeconds = massKg * (change + g * ball.scale * seconds);
            if (ball.blow?.k === k - 1) { if (change > 0) ball.blow.newtonSeconds += newtonSeconds; } // an engine may let a gap close first, and bounce in the next step
            else if (k < steps && change > 3 * threshold && before.vy < -0.5 && before.y - radius > -(engine.sinks ?? 0.03) && (engine.sinks ? ball.lastGap : ball.gap) > nearMetres) blows.push(ball.blow = { id: ball.id, k, newtonSeconds });
            ball.lastGap = ball.gap;
            ball.gap = Math.min(before.y, y) - radius;
        }
    }
    const hits = haptics.take(true).filter(({ kind }) => kind === 'hit').map(event => ({ id: event.fixture, step: event.timeNs * 1e-9 / seconds, newtonSeconds: event.impulse }));
    if (haptics.error) throw haptics.error;
    haptics.free();
    engine.end?.();
    const found = blows.map(blow => ({ ...blow, hits: hits.filter(hit => hit.id === blow.id && hit.step > blow.k - 1.5 && hit.step < blow.k + 2.05) }));
    return { blows: blows.length, missed: found.filter(blow => blow.hits.length === 0), strong: found.filter(blow => blow.hits.length > 0 && !blow.isDisturbed && blow.hits.every(hit => hit.newtonSeconds > 1.35 * blow.newtonSeconds)) };
}

let isBad = false;
console.log('| engine | games | blows | felt | too strong |\n| --- | --- | --- | --- | --- |');
for (const [name, make] of Object.entries(drivers)) {
    if (names.length > 0 ? !names.includes(name) : name === 'mujoco') continue; // whose bodies are those of its model
    let blows = 0, missed = 0, strong = 0;
    for (let seed = 1; seed <= Number(seeds); ++seed) {
        const of = await play(make, seed);
        blows += of.blows;
        missed += of.missed.length;
        strong += of.strong.length;
        for (const each of [...of.missed, ...of.strong]) console.error(`${name}, seed ${seed}: ${JSON.stringify(each)}`);
    }
    isBad ||= missed > 0.005 * blows || strong > 0.001 * blows || blows < 10 * seeds; // a ball may be taken away between the two steps of a blow
    console.log(`| ${name} | ${seeds} | ${blows} | ${blows - missed} | ${strong} |`);
}
process.exit(isBad ? 1 : 0);
