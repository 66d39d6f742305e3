// SPDX-License-Identifier: MIT
// When games are felt that make 30 to 144 pictures a second, for a minute each: clock.mjs. After the first second no step moves the line from a world's time to the
// audio's by a frame, and nothing is late, however coarse the page's clock is. Prints what the latency becomes.
import assert from 'node:assert/strict';
import test from 'node:test';
import { Clock } from '../../Source/Api/JavaScript/package/clock.js';

const rate = 48000, frameNs = 1e9 / rate, fixed = 1 / 60;
function randomOf(state) { return () => { state = (Math.imul(state, 1664525) + 1013904223) >>> 0; return state / 2 ** 32; }; }

/** Steps that a game makes in a picture after `passed` seconds. */
const games = {
    'steps of 1/60 s, one a picture': () => () => [fixed],
    'steps of what has passed': () => passed => [passed],
    'steps of 1/60 s, as many as have passed': () => {
        let left = 0;
        return passed => {
            const steps = [];
            for (left += passed; left >= fixed; left -= fixed) steps.push(fixed);
            return steps;
        };
    },
};

for (const [name, make] of Object.entries(games)) test(name, () => {
    const latencies = [];
    for (const quantum of [128, 512, 1024]) for (const hz of [30, 45, 50, 55, 60, 75, 90, 120, 144]) {
        const clock = new Clock(), random = randomOf(hz), stepsOf = make(), blockNs = quantum * frameNs, nowOf = seconds => Math.floor(seconds * 1e9 / blockNs) * blockNs;
        let world = 0, most = 0, late = 0;
        for (let k = 1; k < 60 * hz; ++k) {
            const seconds = k / hz + 0.002 * random(), now = nowOf(seconds); // pictures come up to 2 ms late
            for (const step of stepsOf(1 / hz)) {
                const before = clock.at(world);
                const last = world;
                world += step * 1e9;
                clock.align(Math.round(world), now);
                if (seconds < 1.2) continue;
                most = Math.max(most, Math.abs(clock.at(last) - before));
                if (clock.at(world - step * 1e9) < now + 0.5 * blockNs) ++late; // the oldest event that a step may give
            }
        }
        assert.ok(most < frameNs, `${hz} pictures a second, blocks of ${quantum}: a step moved the line by ${most} ns`);
        assert.deepEqual({ hz, quantum, late, moves: clock.moves }, { hz, quantum, late: 0, moves: 0 });
        if (quantum === 512) latencies.push(`${hz}: ${(clock.latencyNs / 1e6).toFixed(0)}`);
    }
    console.log(`${name}: latency in ms by pictures a second: ${latencies.join(', ')}`);
});

// What games meet: pictures (a second) from that time (s) on, and pictures that come so much later, ms, now and then. `most`: of a step that a game makes of one picture.
const timelines = {
    'from 60 pictures to 30, and back': { pictures: [[0, 60], [5, 30], [12, 60]] },
    'from 30 pictures to 144, and to 60': { pictures: [[0, 30], [5, 144], [12, 60]] },
    'a slow start': { pictures: [[0, 8], [1, 60]] },
    'a start that stutters': { pictures: [[0, 60]], hitches: [[0.2, 300], [0.5, 150], [0.8, 400]] },
    'hitches of 40 to 1,000 ms': { pictures: [[0, 60]], hitches: [[4, 40], [8, 100], [12, 300], [16, 1000], [20, 50], [20.4, 50]] },
    'hitches at 144 pictures': { pictures: [[0, 144]], hitches: [[4, 40], [8, 100], [12, 300], [16, 1000]] },
    'hitches at 30 pictures': { pictures: [[0, 30]], hitches: [[4, 50], [8, 100], [12, 300], [16, 1000]] },
};
const longest = 0.1; // s: of a step; games leave out what is more
const modes = {
    ...games,
    'steps of what has passed, at most 0.1 s': () => passed => [Math.min(longest, passed)],
    'steps of 1/60 s, as many as have passed, at most six': () => { const all = games['steps of 1/60 s, as many as have passed'](); return passed => all(Math.min(longest, passed)); },
};
for (const [name, { pictures, hitches = [] }] of Object.entries(timelines)) for (const [mode, make] of Object.entries(modes)) test(`${name}, ${mode}`, () => {
    for (const quantum of [128, 512, 1024]) {
        const clock = new Clock(), random = randomOf(7), stepsOf = make(), blockNs = quantum * frameNs, nowOf = seconds => Math.floor(seconds * 1e9 / blockNs) * blockNs;
        const breaks = [...pictures.map(([from]) => from), ...hitches.map(([at, ms]) => at + ms / 1000)], waiting = [...hitches], steps = [];
        const isCalm = (seconds, after) => breaks.every(at => seconds < at || seconds > at + after);
        let world = 0, last = 0, late = 0, most = 0, moved = 0, learnsUntil = 0;
        for (let seconds = 0; seconds < 25;) {
            let passed = 1 / pictures.findLast(([from]) => from <= seconds)[1];
            if (waiting.length && seconds >= waiting[0][0]) passed += waiting.shift()[1] / 1000;
            seconds += passed;
            const now = nowOf(seconds + 0.002 * random());
            for (const step of stepsOf(passed)) {
                const before = clock.at(world), { moves } = clock, from = world;
                world += step * 1e9;
                steps.push(from);
                clock.align(Math.round(world), now);
                if (isCalm(seconds, 1) && clock.at(from) < now + 0.5 * Math.min(blockNs, 5e6)) ++late;
                if (!isCalm(seconds, 1.5) || seconds < 1.2) continue;
                const by = Math.abs(clock.at(from) - before);
                if (clock.moves > moves) ++moved, learnsUntil = seconds + 0.7; // the latency is made smaller, once things are calm
                else if (seconds > learnsUntil) most = Math.max(most, by);
            }
            last = seconds;
        }
        assert.ok(most < frameNs, `blocks of ${quantum}: a step moved the line by ${most} ns`);
        assert.ok(late === 0 && moved <= breaks.length, `blocks of ${quantum}: ${late} late a second after a break, ${moved} moves`);
        assert.ok(clock.latencyNs < (pictures.at(-1)[1] === 30 ? 125e6 : 106e6), `blocks of ${quantum}: latency ${clock.latencyNs} at the end`);
        assert.ok(last > 24);
    }
});

test('a game that stands still is aligned once, and one that becomes slow is learned anew', () => {
    const clock = new Clock();
    let world = 0, now = 0;
    const run = (count, stepMs, passedMs) => { for (let i = 0; i < count; ++i) clock.align(world += stepMs * 1e6, now += passedMs * 1e6); };
    run(100, 16, 16);
    now += 3000e6;
    run(100, 16, 16);
    assert.equal(clock.moves, 1);
    assert.ok(Math.abs(clock.at(world) - now - clock.latencyNs) < frameNs);
    run(200, 4, 16); // slow motion
    assert.ok(clock.moves <= 3 && Math.abs(clock.at(world) - now - clock.latencyNs) < 1e6, `${clock.moves} moves`);
    const given = new Clock(0.03);
    for (let i = 0; i < 200; ++i) given.align(i * 33e6, i * 33e6);
    assert.equal(given.latencyNs, 0.03e9); // what the page has asked for
});
