// SPDX-License-Identifier: MIT
// The plug-in for jsPsych, with jsPsych's own types and a stub of an experiment: jspsych.mjs FOLDER.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder] = process.argv.slice(2);
globalThis.window ??= {}; // jsPsych looks for one when it is loaded
const physvib = await (await load(folder, 'physvib')).load(), { default: Plugin } = await load(folder, 'jspsych-physvib');

function run(stimulus, more = {}) {
    const settings = { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 }, struck = [], played = [], timers = [], element = {};
    const output = { context: { currentTime: 1.00001, sampleRate: 48000, outputLatency: 0.02 }, physvib, settings, latencyFrames: 47, status: { late: 0 },
        strike: (events, laterNs) => struck.push({ events, laterNs }), playSamples: (channels, seconds) => played.push({ channels, seconds }), left: (from, to) => [from, to] };
    let result = null, key = null;
    const pluginAPI = { clearAllTimeouts() {}, cancelAllKeyboardResponses() {}, setTimeout: (call, ms) => timers.push({ call, ms }), getKeyboardResponse: ({ callback_function }) => { key = callback_function; } };
    const defaults = Object.fromEntries(Object.entries(Plugin.info.parameters).map(([name, { default: value }]) => [name, value]));
    new Plugin({ finishTrial: data => { result = data; }, pluginAPI }).trial(element, { ...defaults, output, stimulus, ...more });
    return { struck, played, timers, end(passed = 10) { output.context.currentTime += passed; timers[0].call(); return result; }, press(letter) { key({ key: letter }); return result; }, element };
}

test('a strike has its onset to the sample, and the trial says so', () => {
    const { struck: [{ events, laterNs }], timers, end } = run({ message: 'strike', frequencyHz: 200, decayPerSecond: 30, place: { x: 0.25, y: 0.5 } });
    const frame = Math.ceil(1.05001 * 48000), data = end();
    assert.deepEqual([data.onset_frame, laterNs, data.output_latency_s, data.late], [frame + 47, Math.round(frame / 48000 * 1e9), 0.02, false]);
    assert.deepEqual(data.gains, [[0.375, 0.125, 0.375, 0.125]]);
    assert.ok(data.left[0] === data.onset_s && Math.abs(data.left[1] - data.onset_s - 6.9 / 30) < 1e-9, 'what left, from its onset to its end');
    const early = run({ message: 'phantom' }).end(0.2), untilNow = 1.00001 + 0.2 - 0.1;
    assert.ok(Math.abs(early.left[1] - untilNow) < 1e-9, 'and no more than is known');
    assert.deepEqual(JSON.parse(data.call), { message: 'strike', frequencyHz: 200, decayPerSecond: 30, place: { x: 0.25, y: 0.5 } });
    assert.ok(events.length === 1 && timers[0].ms > 280);
    // What an audio thread would make of it begins at that frame.
    const [samples] = physvib.render([{ ...events[0], timeNs: 1000 * 1e9 / 48000 }], { seconds: 0.1, layout: 'phone4', fieldWidth: 1, fieldHeight: 1 });
    assert.ok(samples.subarray(0, 1000).every(sample => sample === 0) && samples[1002] !== 0);
    for (const name of Object.keys(data)) assert.ok(name in Plugin.info.data, name);
});

test('pattern, phantom, path, clip; keys; refusals', () => {
    const pattern = run({ message: 'pattern', actuators: 'ABD', pulseSeconds: 0.1, gapSeconds: 0.1 }).end();
    assert.deepEqual(pattern.times_s, [0, 0.2, 0.4]);
    pattern.gains.forEach((gains, i) => assert.equal(gains[[0, 1, 3][i]], 1));
    assert.deepEqual(run({ message: 'phantom' }).end().gains, [[0.25, 0.25, 0.25, 0.25]]);
    const { struck: [{ events }] } = run({ message: 'path', from: { x: 0, y: 0.5 }, to: { x: 1, y: 0.5 }, seconds: 0.5, frequencyHz: 100 });
    const [left] = physvib.render(events, { seconds: 0.6, layout: 'phone2', fieldWidth: 1, fieldHeight: 1, limiter: false });
    assert.ok(events.length === 50 && Math.max(...left.subarray(0, 2000)) > 0.45 && Math.max(...left.subarray(22000, 24000)) < 0.05);
    const steps = left.subarray(1, 23900).map((sample, n) => Math.abs(sample - left[n]));
    assert.ok(Math.max(...steps) < 0.5 * 2 * Math.PI * 100 / 48000 * 1.1, 'no jump from one period to the next');
    const clip = { channels: [1, 2, 3, 4].map(() => new Float32Array(4800)) }, { played, end } = run({ message: 'clip', clip });
    assert.equal(played[0].seconds, Math.ceil(1.05001 * 48000) / 48000);
    assert.equal(end().onset_frame, Math.ceil(1.05001 * 48000));
    const asked = run({ message: 'phantom' }, { choices: ['a', 'b'] }).press('b');
    assert.ok(asked.response === 'b' && Number.isInteger(asked.rt));
    assert.throws(() => run({ message: 'pattern', actuators: 'AZ' }), /letters from A to D/);
    assert.throws(() => run({ message: 'tickle' }), /strike, pattern, phantom, path or clip|tickle/);
});
