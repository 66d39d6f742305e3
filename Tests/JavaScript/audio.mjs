// SPDX-License-Identifier: MIT
// The audio thread's file in a stub of a page's: audio.mjs FOLDER. Its samples are those of render, at the times that the page gives them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import test, { after } from 'node:test';
import { Context as Fake, quantum, rate } from './fake-audio.mjs';
import { load } from './installed.mjs';

const folder = resolve(process.argv[2]);
const physvib = await (await load(folder, 'physvib')).load(), audio = await load(folder, 'physvib/audio'), opened = [];
async function play(...given) {
    const output = await audio.play(...given);
    opened.push(output);
    return output;
}
after(() => { for (const output of opened) try { output.close(); } catch { /* it has ended */ } }); // what looks for devices ends
const code = readFileSync(createRequire(join(folder, 'index.js')).resolve('physvib/worklet.js'), 'utf8');

/** A context on a device with so many outputs, in a browser on Linux. */
class Context extends Fake { constructor(outputs) { super(code, outputs); } }
test('a game at a variable rate is felt with constant latency, as render has it', async () => {
    const context = new Context(8), output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1, latency: 0.08 }), followers = new Set(), world = physvib.world();
    assert.ok(output.isDirect && output.channels === 4);
    world.setBody(0);
    world.setBody(1, { massKg: 1, isSource: true, frequencyHz: 200, decayPerSecond: 30 });
    output.follow({ follow: follower => { followers.add(follower); return () => followers.delete(follower); } });
    context.run(20);
    const struck = [], steps = [8, 8, 4, 12, 6, 9, 3, 8, 14, 8, 8, 8, 8, 8, 8], nsOf = quanta => quanta * quantum / rate * 1e9, startNs = nsOf(20 + steps[0]) - Math.round(nsOf(steps[0]));
    steps.forEach((quanta, i) => {
        context.run(quanta); // the game's frame comes late or early; its step is what passed
        world.step(quanta * quantum / rate, 9.81, () => (i % 4 === 1 ? world.touch(0, 1, { x: 0.2 + 0.1 * i, y: 0.5, approach: 0.5, fraction: 0.3 }) : undefined));
        const events = world.take();
        struck.push(...events);
        for (const follower of followers) follower(events, world);
    });
    context.run(200);
    assert.equal(output.moves, 0);
    assert.ok(struck.length >= 3);
    const shifted = struck.map(event => ({ ...event, timeNs: Math.round(event.timeNs + startNs + 80e6) }));
    const wanted = physvib.render(shifted, { seconds: context.frame / rate, layout: 'phone4', fieldWidth: 1, fieldHeight: 1 }), late = physvib.renderer({ layout: 'phone4' }).latencyFrames;
    wanted.forEach((channel, j) => {
        const got = Float32Array.from(context.recorded[j]).subarray(late), off = got.reduce((most, sample, n) => Math.max(most, Math.abs(sample - channel[n])), 0);
        assert.ok(off === 0, `channel ${j} is off by ${off}`);
    });
    await null;
    assert.equal(output.status.late, 0);
    output.strike([{ ...struck[0], timeNs: 0 }], 0); // long over
    context.run(200);
    await null;
    assert.equal(output.status.late, 1);
    output.close();
    context.run(1);
    assert.equal(context.isAlive, false);
});

test('an output of a context that runs for a while already is felt at once', async () => {
    const context = new Context(4);
    context.frame = 1000 * quantum;
    const output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 });
    context.run(20);
    output.impact({ x: 0.5, y: 0.5, strength: 0.8 });
    context.run(20);
    const onset = context.recorded[0].findIndex(sample => sample !== 0) - output.latencyFrames;
    assert.ok(onset >= 20 * quantum && onset < 22 * quantum, `${onset / quantum} blocks`);
    output.close();
});

test('two outputs: a stereo monitor, each actuator at its place; gains, mutes and silence arrive', async () => {
    const context = new Context(2), output = await play(physvib, context, { layout: 'phone2', fieldWidth: 1, fieldHeight: 1 });
    assert.ok(!output.isDirect);
    context.run(1);
    output.setMute(0, true);
    output.strike([{ timeNs: 0, frequencyHz: 100, decayPerSecond: 20, amplitude: 0.5, x: 0.5, y: 0.5 }]);
    context.run(100);
    assert.ok(context.recorded[0].slice(1000).every(sample => sample === 0) && context.recorded[1].some(sample => sample !== 0));
    const before = context.recorded[1].length;
    output.impact({ x: 1, y: 0.5, strength: 0.8, material: 'wooden board' });
    context.run(100);
    assert.ok(Math.max(...context.recorded[1].slice(before)) > 0.1);
    assert.ok(context.peaks(2000)[0] < 1e-6 && context.peaks(2000)[1] > 0.02, `${context.peaks(2000)}`);
    output.silence();
    context.run(20);
    assert.ok(context.recorded[1].slice(-quantum).every(sample => sample === 0));
    output.setLayout({ law: 'energy' });
    output.setGain(1, 0.5);
    context.run(1);
});

test('frames that the browser leaves out, as for a module that is read, are over: later hits are in time', async () => {
    const onsets = [];
    for (const left of [0, 640, 64000]) {
        const context = new Context(8), output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 });
        context.run(20);
        context.frame += left;
        context.run(20); // of a long time it is made up for bit by bit
        const due = context.currentTime + 0.02, before = context.recorded[0].length;
        output.strike([{ timeNs: 0, frequencyHz: 100, decayPerSecond: 20, amplitude: 0.5, x: 0.5, y: 0.5 }], due * 1e9);
        context.run(60);
        onsets.push(context.recorded[0].slice(before).findIndex(sample => sample !== 0));
        context.run(100);
        await null;
        assert.equal(output.skipped, left);
        assert.equal(output.status.late, 0);
    }
    assert.ok(Math.abs(onsets[0] - 0.02 * rate - physvib.renderer({ layout: 'phone4' }).latencyFrames) <= 2 && onsets.every(onset => onset === onsets[0]), String(onsets));
});

test('a context that is suspended: what happens meanwhile is not felt later, and the clock does not move', async () => {
    const context = new Context(8), output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 });
    let follower;
    output.follow({ follow: one => { follower = one; return () => {}; } });
    const hit = timeNs => ({ timeNs, frequencyHz: 100, decayPerSecond: 200, amplitude: 0.5, x: 0.5, y: 0.5 }), nsOf = quanta => quanta * quantum / rate * 1e9;
    let world = 0;
    const step = (runs, events = []) => { world += nsOf(6); if (runs) context.run(6); follower(events, { timeNs: world }); };
    for (let i = 0; i < 80; ++i) step(true);
    context.state = 'suspended';
    for (let i = 0; i < 80; ++i) step(false, [hit(world)]);
    context.state = 'running';
    for (let i = 0; i < 40; ++i) step(true);
    assert.ok(context.recorded[0].every(sample => sample === 0), 'what was missed is over');
    assert.equal(output.moves, 1);
    step(true, [hit(world)]);
    context.run(60);
    await null;
    assert.ok(context.recorded[0].some(sample => sample !== 0) && output.status.late === 0);
});

test('an audio thread that ends is told once, and nobody waits for it', async () => {
    const context = new Context(8), output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 }), lines = [], { error } = console;
    console.error = line => lines.push(line);
    try {
        assert.equal(output.error, null);
        output.node.onprocessorerror();
        output.node.onprocessorerror();
        await assert.rejects(output.arrived(), /audio thread has ended/);
        output.strike([]);
    } finally { console.error = error; }
    assert.match(output.error.message, /play anew/);
    assert.equal(lines.length, 1);

    const other = new Context(8), second = await play(physvib, other, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 }), waiting = second.arrived();
    console.error = line => lines.push(line);
    try {
        other.processor.lib = { malloc() { throw new Error('memory'); } };
        other.run(1);
        await waiting.catch(() => {});
    } finally { console.error = error; }
    await null;
    assert.ok(!other.isAlive && /memory/.test(second.error?.message), `${second.error}`);
    assert.equal(lines.length, 2);
});

test('modules that cannot be had are named, with what to do', async () => {
    const context = new Context(2);
    context.audioWorklet.addModule = async () => { throw new Error('Not found'); };
    await assert.rejects(play(physvib, context, { worklet: '/there/worklet.js' }), /\/there\/worklet.js: .*Not found.*option worklet/);
    await assert.rejects(load(folder, 'physvib').then(({ load: code }) => code('file:///nowhere/physvib.wasm')), /file:\/\/\/nowhere\/physvib.wasm: .*no such file.*physvib\/inline/);
    const { load: code } = await load(folder, 'physvib');
    globalThis.document = { baseURI: 'https://example.org/game/' };
    const { fetch } = globalThis, asked = [];
    globalThis.fetch = async address => { asked.push(String(address)); return new Response('', { status: 404 }); };
    try {
        await assert.rejects(code('assets/physvib.wasm'), /https:\/\/example.org\/game\/assets\/physvib.wasm: .*the server answers 404/);
    } finally {
        globalThis.fetch = fetch;
        delete globalThis.document;
    }
    assert.deepEqual(asked, ['https://example.org/game/assets/physvib.wasm'], 'a relative address is the page\'s');
    const inside = await (await load(folder, 'physvib/inline')).load();
    assert.equal(inside.version, physvib.version);
    assert.match(inside.worklet, /registerProcessor/);
});

test('what is played is explained: field, level, mutes, and a context that stands still', async () => {
    const context = new Context(8), world = physvib.world(), output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 });
    const hit = async (x = 0.5) => {
        world.step(0.01, 9.81, () => world.touch(1, 0, { x, y: 0.5, normalX: 0, normalY: -1, approach: 3 }));
        output.impact({ x, y: 0.5 });
        context.run(context.state === 'suspended' ? 0 : 400);
        await null;
        return world.explain(output);
    };
    world.setBody(0);
    world.setBody(1, { massKg: 2, isSource: true, frequencyHz: 200, decayPerSecond: 30 });
    world.step(0.01, 9.81);
    const again = async said => { world.step(0.01, 9.81); assert.match(await hit(), said); }, left = /and what left the output reached [\d.]+ % of full scale: if nothing is felt, look at amplifier and cables\.$/;
    assert.match(await hit(), left);
    for (let j = 0; j < 4; ++j) output.setMute(j, true);
    await again(/channels that play these places are muted/);
    for (let j = 0; j < 4; ++j) output.setMute(j, false);
    await again(left);
    output.setLevel(0);
    await again(/level of the output is 0/);
    output.setLevel(0.5);
    output.setLayout({ fieldWidth: 0.1, fieldHeight: 0.1 });
    await again(/set fieldWidth and fieldHeight of the renderer/);
    output.setLayout({ fieldWidth: 1, fieldHeight: 1 });
    context.state = 'suspended';
    await again(/^The AudioContext is suspended: call resume\(\) in a click\. 1 event was made, .*, and nothing has left the output since [\d.]+ s of the context's time: the context is suspended\.$/);
    context.state = 'running';
    await again(left);
    for (let j = 0; j < 4; ++j) output.setGain(j, 0);
    context.run(20);
    await null;
    world.explain(output);
    await again(/nothing has left the output since .*gains are 0/);
});

test('haptics explain what follows them, unasked, until it has ended', async () => {
    const context = new Context(8), output = await play(physvib, context, { layout: 'phone4', fieldWidth: 1, fieldHeight: 1 });
    const { attachVelocities } = await load(folder, 'physvib/velocities'), haptics = attachVelocities(physvib, { bodies: () => [], read() {} });
    const end = output.follow(haptics);
    context.state = 'suspended';
    haptics.update(0.01);
    assert.match(haptics.explain(), /^The AudioContext is suspended/);
    assert.match(haptics.explain(output), /^The AudioContext is suspended/);
    end();
    assert.doesNotMatch(haptics.explain(), /AudioContext/);
    output.follow(haptics);
    output.close();
    assert.doesNotMatch(haptics.explain(), /AudioContext/);
});

test('options that are none are refused in a line', async () => {
    const refused = (options, message) => assert.rejects(play(physvib, new Context(8), { fieldWidth: 1, fieldHeight: 1, ...options }), { message });
    await refused({ level: 200 }, 'level: expected 0 to 1, found 200');
    await refused({ level: -1 }, 'level: expected 0 to 1, found -1');
    await refused({ latency: -1 }, 'latency: expected 0 to 10 s, found -1');
    await refused({ latency: 60 }, 'latency: expected 0 to 10 s, found 60');
    await refused({ latncy: 0.06 }, /^latncy: expected one of .*fieldWidth.*, latency, level, outputs, worklet$/);
    await assert.rejects(play(Promise.resolve(physvib), new Context(8)), { message: 'play: expected the library (await load()), found Promise' });
    const output = await play(physvib, new Context(8), { latency: 0, level: 1 });
    assert.throws(() => output.setLevel(50), /level: expected 0 to 1, found 50/);
    assert.throws(() => output.setLayout({ layout: 'phone4', law: 'none' }), /law/);
    assert.throws(() => output.setLayout({ layout: 'phone2' }), { message: 'layout: expected 4 actuators (for others close this output, and play anew), found 2' });
    assert.equal(output.settings.layout, undefined);
    for (const [act, message] of [[() => output.setGain(99, 5), 'actuator: expected 0 to 3, found 99'], [() => output.setGain(0, NaN), 'gain: expected 0 to 10000, found NaN'], [() => output.setMute('x', true), 'actuator: expected 0 to 3, found x'],
        [() => output.setLayout({ fieldWidth: NaN }), 'fieldWidth: expected a number, found NaN'], [() => output.setLayout({ exponent: -1 }), /exponent/], [() => output.follow(null), 'follow: expected what attach returns, found null'],
        [() => output.left(1, 0), /^left: expected two times/]]) assert.throws(act, { name: 'PhysVibError', message });
    await assert.rejects(output.buzz(4), { name: 'PhysVibError', message: 'actuator: expected 0 to 3, found 4' });
    await assert.rejects(play(physvib), { name: 'PhysVibError', message: 'play: expected an AudioContext, found undefined' });
    const places = count => ({ extentWidth: 1, extentHeight: 1, places: Array.from({ length: count }, (_, i) => ({ x: i / count, y: 0.5 })) });
    await refused({ layout: places(33) }, /^layout: expected at most 32 actuators/);
});

test('a page without audio worklets says why', async () => {
    globalThis.isSecureContext = false;
    await assert.rejects(play(physvib, {}), /https/);
});

const later = ms => new Promise(done => setTimeout(done, ms));
async function until(holds) { for (const began = performance.now(); !holds() && performance.now() - began < 30000;) await later(10); } // what then must hold is asserted

// ---- outputs of a device
const userAgents = { linux: 'Mozilla/5.0 (X11; Linux x86_64; rv:153.0) Gecko/20100101 Firefox/153.0', windows: 'Mozilla/5.0 (Windows NT 10.0; Win64; x64)', android: 'Mozilla/5.0 (Linux; Android 10; K)' };
function inBrowser(system, mediaDevices) { Object.defineProperty(globalThis, 'navigator', { configurable: true, value: { userAgent: userAgents[system], mediaDevices } }); }
const row = count => ({ extentWidth: count, extentHeight: 1, places: Array.from({ length: count }, (_, i) => ({ x: i + 0.5, y: 0.5 })) });
const onRow = (count, more = {}) => ({ layout: row(count), fieldWidth: count, fieldHeight: 1, law: 'neighbours', level: 1, ...more });
/** Which channels of the context each actuator is heard at. */
async function heardAt(context, output) {
    const all = [];
    for (let j = 0; j < output.channels; ++j) {
        const since = (context.run(20), context.heard[0].length);
        output.strike([{ timeNs: 0, frequencyHz: 1000, decayPerSecond: 2000, amplitude: 0.5, x: j + 0.5, y: 0.5 }]);
        context.run(10);
        all.push(context.peaks(since).flatMap((peak, i) => (peak > 0.05 ? [i] : [])).join('+'));
    }
    return all.join(' ');
}

test('each actuator is at the device output of its number, where loudspeakers are numbered otherwise', async () => {
    const order = { linux: { 3: '0 1 2', 4: '0 1 2 3', 5: '0 1 3 4 2', 6: '0 1 4 5 2 3', 7: '0 1 2 3 4 5 6', 8: '0 1 4 5 2 3 6 7', 12: '0 1 2 3 4 5 6 7 8 9 10 11' }, windows: {}, android: {} };
    for (const [system, special] of Object.entries(order)) {
        inBrowser(system);
        for (const outputs of system === 'linux' ? [3, 4, 5, 6, 7, 8, 12] : [8]) for (let count = outputs > 8 ? outputs : 1; count <= outputs; ++count) {
            const context = new Context(outputs), output = await play(physvib, context, onRow(count)), wanted = (special[outputs] ?? Array.from({ length: outputs }, (_, i) => i).join(' ')).split(' ').slice(0, count).join(' ');
            assert.ok(output.isDirect);
            assert.equal(context.destination.channelCount, outputs, 'fewer would be loudspeakers, which a sound server spreads');
            assert.equal(await heardAt(context, output), wanted, `${system}: ${count} actuators on ${outputs} outputs`);
            output.close();
        }
    }
});

test('outputs of one\'s own, and what is none', async () => {
    inBrowser('linux');
    const context = new Context(8), output = await play(physvib, context, onRow(3, { outputs: [8, 3, 1] }));
    assert.equal(await heardAt(context, output), '7 4 0');
    const stereo = new Context(2), two = await play(physvib, stereo, onRow(2, { outputs: [2, 1] }));
    assert.ok(two.isDirect);
    assert.equal(await heardAt(stereo, two), '1 0');
    for (const outputs of [[1, 2], [1, 2, 2], [0, 1, 2], [1, 2, 9], [1, 2, 2.5], 3, 'abc', [1, 2, NaN]])
        await assert.rejects(play(physvib, new Context(8), onRow(3, { outputs })), { name: 'PhysVibError', message: `outputs: expected 3 different numbers, 1 to 8 (outputs of this device), found ${outputs}` });
});

test('another device: what isDirect says is how it is connected', async () => {
    inBrowser('linux');
    const context = new Context(8), output = await play(physvib, context, onRow(4));
    context.destination.maxChannelCount = 2;
    context.dispatchEvent(new Event('sinkchange'));
    await later(1);
    context.heard = [];
    assert.ok(!output.isDirect && context.destination.channelCount === 2);
    assert.equal((await play(physvib, new Context(8), onRow(9))).context.destination.channelCount, 8, 'a monitor takes no outputs from another output of its context');
    assert.equal(await heardAt(context, output), '0+1 0+1 0+1 0+1');
    context.destination.maxChannelCount = 6;
    context.dispatchEvent(new Event('sinkchange'));
    await later(1);
    assert.ok(output.isDirect);
    context.heard = [];
    assert.equal(await heardAt(context, output), '0 1 4 5');
});

test('a buzz is felt at its actuator alone, at the level, and ends', async () => {
    inBrowser('linux');
    const context = new Context(8), output = await play(physvib, context, onRow(5, { level: 0.5 }));
    for (let j = 0; j < 5; ++j) {
        const since = (context.run(1), context.heard[0].length), over = output.buzz(j);
        context.run(130);
        await over;
        const peaks = context.peaks(since);
        assert.ok(Math.abs(peaks[[0, 1, 4, 5, 2][j]] - 0.25) < 0.005 && peaks.filter(peak => peak > 0).length === 1, `${j}: ${peaks}`);
    }
    context.state = 'suspended';
    await assert.rejects(output.buzz(0), { message: 'buzz: expected a device that runs, found suspended' });
});

test('two worlds of other ages follow one output: each is on time', async () => {
    const context = new Context(8), output = await play(physvib, context, onRow(1)), due = [], felt = [], strike = output.strike.bind(output);
    output.strike = (events, laterNs) => { felt.push(...events.map(({ timeNs }) => timeNs * 1e-9)); strike(events, laterNs); };
    const world = () => {
        let follower, ns = 0;
        const end = output.follow({ follow: one => { follower = one; return () => {}; } });
        return { end, step(isHit) {
            if (isHit) due.push(context.currentTime);
            follower(isHit ? [{ timeNs: ns, frequencyHz: 100, decayPerSecond: 200, amplitude: 0.5, x: 0.5, y: 0.5 }] : [], { timeNs: ns += 6 * quantum / rate * 1e9 });
        } };
    };
    assert.equal(output.latency, 0.06); // until somebody follows
    const worlds = [world()];
    for (let i = 0; i < 700; ++i) {
        context.run(6);
        if (i === 400) worlds.push(world());
        for (const [j, one] of worlds.entries()) one.step(i > 100 && i % 25 === 7 * j);
    }
    context.run(60);
    await null;
    assert.ok(felt.length > 30 && felt.every((at, i) => at - due[i] > 0 && at - due[i] < 0.1), felt.map((at, i) => (at - due[i]).toFixed(3)).join(' '));
    assert.deepEqual([output.moves, output.status.late], [0, 0]);
    assert.ok(output.latency > 0.016 && output.latency < 0.045, String(output.latency)); // a step of 16 ms, the clock's grain, a reserve
    worlds[1].end();
    assert.equal(output.moves, 0);
});

// ---- what left
test('receipts: frames, peak and mean square of each actuator are those of the samples that left', async () => {
    const context = new Context(8), output = await play(physvib, context, onRow(3, { level: 0.5 })), blocks = 64;
    context.run(blocks);
    output.impact({ x: 0.5, y: 0.5, strength: 0.8 });
    output.playSamples([0, 1, 2].map(j => new Float32Array(4800).fill(j === 2 ? 0.25 : 0)));
    context.run(2 * blocks);
    await null;
    const from = blocks * quantum / rate, to = 3 * blocks * quantum / rate, found = output.left(from, to);
    found.forEach(({ frames, peak, meanSquare, running }, j) => {
        const samples = context.heard[[0, 1, 4][j]].slice(blocks * quantum);
        assert.ok(running && frames === 2 * blocks * quantum);
        assert.ok(Math.abs(peak - samples.reduce((most, value) => Math.max(most, Math.abs(value)), 0)) < 1e-7);
        assert.ok(Math.abs(meanSquare - samples.reduce((sum, value) => sum + value * value, 0) / samples.length) < 1e-7);
    });
    assert.ok(found[0].peak > 0.2 && found[1].peak === 0 && Math.abs(found[2].peak - 0.125) < 1e-6);
    assert.equal(output.left(to, to + 1)[0].running, false, 'not yet');
    assert.equal(output.left(from, to + 1)[0].running, false, 'not all of it');
    output.setLevel(0);
    output.impact({ x: 0.5, y: 0.5, strength: 0.8 });
    context.run(blocks);
    await null;
    assert.deepEqual(output.left(to, to + blocks * quantum / rate)[0], { frames: blocks * quantum, peak: 0, meanSquare: 0, running: true });
    context.run(5);
    const gap = context.currentTime;
    context.frame += 20 * quantum; // the browser left them out
    context.run(32);
    await null;
    assert.equal(output.left(gap, gap + 20 * quantum / rate)[0].frames, 0);
    const { running, frames } = output.left(to, gap + 36 * quantum / rate)[0];
    assert.ok(!running && frames === (blocks + 5 + 16) * quantum, `${frames / quantum} blocks`);
    context.run(8192 + 64);
    await null;
    assert.deepEqual(output.left(from, to)[0], { frames: 0, peak: 0, meanSquare: 0, running: false }, 'too long ago');
});

// ---- states
const statesOf = output => { const states = []; output.addEventListener('state', ({ state }) => states.push(state)); return states; };

test('what is meant for now is dropped, and counted, where the context stands still; unless it resumes at once', async () => {
    inBrowser('linux');
    const context = new Context(8), output = await play(physvib, context, onRow(1)), states = statesOf(output);
    context.run(10);
    context.state = 'suspended';
    output.impact({ x: 0.5, y: 0.5 });
    output.playSamples([new Float32Array(4800).fill(0.25)]);
    await until(() => output.dropped > 1);
    assert.equal(output.dropped, 2);
    context.state = 'running';
    context.run(60);
    await later(1);
    assert.ok(context.peaks()[0] === 0);
    context.state = 'suspended';
    output.impact({ x: 0.5, y: 0.5 });
    context.state = 'running';
    context.run(60);
    await later(1);
    assert.ok(context.peaks()[0] > 0.1 && output.dropped === 2);
    assert.deepEqual(states, ['suspended', 'running']);
    const { currentTime } = context, { port } = output.node, post = port.postMessage;
    port.postMessage = message => { context.run(5); post(message); }; // it comes later
    output.impact({ x: 0.5, y: 0.5 });
    context.run(200);
    await null;
    assert.equal(output.status.late, 0, 'what is meant for now is not late');
    output.strike([{ timeNs: currentTime * 1e9, frequencyHz: 100, decayPerSecond: 20, amplitude: 0.5, x: 0.5, y: 0.5 }], 0);
    context.run(200);
    await null;
    assert.equal(output.state, 'late');
    await later(1100);
    context.run(200);
    await null;
    assert.deepEqual(states.slice(2), ['late', 'running']);
});

test('Chromium: a device that fails, is away, and comes back is said, and taken again', async () => {
    let devices = [{ kind: 'audiooutput' }], listing = null;
    inBrowser('linux', Object.assign(new EventTarget(), { async enumerateDevices() { await listing; return devices; } }));
    const context = new Context(8), asked = [];
    Object.assign(context, { sinkId: '', async setSinkId(id) {
        asked.push(id);
        if (id === '' && devices.length === 0) throw new Error('not found');
        this.sinkId = id;
        this.dispatchEvent(new Event('sinkchange'));
    } });
    const output = await play(physvib, context, onRow(1)), states = statesOf(output), heard = [];
    output.onstate = ({ state }) => heard.push(state);
    context.run(20);
    devices = [];
    context.resume = async () => new Promise(() => {}); // as Chromium has it while there is no device
    context.dispatchEvent(new Event('error'));
    context.state = 'suspended';
    await later(10);
    assert.equal(output.state, 'device lost');
    assert.match(output.hint(), /^The sound device is lost/);
    assert.deepEqual(asked, []);
    devices = [{ kind: 'audiooutput' }];
    context.resume = async () => { context.state = 'running'; };
    await until(() => output.state === 'running');
    assert.equal(output.state, 'running');
    assert.deepEqual(asked, [{ type: 'none' }, '']);
    assert.deepEqual(states, heard);
    assert.deepEqual(states.filter((state, i) => state !== states[i - 1]), ['suspended', 'device lost', 'running'].slice(states[0] === 'suspended' ? 0 : 1));
    // One that a game has suspended itself stays so.
    context.state = 'suspended';
    await later(10);
    context.dispatchEvent(new Event('error'));
    await later(1300);
    assert.equal(output.state, 'device lost');
    assert.equal(context.state, 'suspended');
    assert.equal(asked.length, 2);
    // Made where there is none, it runs, and nothing leaves.
    devices = [];
    const { setSinkId } = context, made = () => Object.assign(new Context(2), { sinkId: '', setSinkId }), feigned = await play(physvib, made(), onRow(1));
    await later(10);
    assert.equal(feigned.state, 'device lost');
    feigned.context.run(40);
    await null;
    assert.equal(feigned.left(0, feigned.context.currentTime)[0].frames, 0);
    let listed;
    listing = new Promise(done => { listed = done; });
    const hasty = await play(physvib, made(), onRow(1)), world = physvib.world();
    hasty.impact({ x: 0.5, y: 0.5 }); // before the browser has listed its devices
    hasty.context.run(40);
    await later(10);
    assert.ok(hasty.left(0, hasty.context.currentTime - 0.05)[0].running, 'as far as is known');
    listed();
    await later(10);
    world.setBody(0);
    world.setBody(1, { massKg: 2, isSource: true, frequencyHz: 200, decayPerSecond: 30 });
    for (let i = 0; i < 2; ++i) world.step(0.01, 9.81, () => { if (i > 0) world.touch(1, 0, { x: 0.5, y: 0.5, normalX: 0, normalY: -1, approach: 3 }); });
    assert.match(world.explain(hasty), /^The sound device is lost.* and nothing has left the output since it was opened: the device is lost\.$/);
    assert.equal(hasty.left(0, hasty.context.currentTime)[0].frames, 0);
    devices = [{ kind: 'audiooutput' }];
    asked.splice(0);
    output.close();
    await until(() => [feigned, hasty].every(({ state }) => state === 'running')); // looked for each second
    assert.deepEqual([feigned.state, hasty.state, asked.length], ['running', 'running', 4], 'it has gone on to the device, and was not only called so');
    for (const one of [feigned, hasty]) one.close();
});

test('Firefox: a context that runs on without a device says so, and what it rendered meanwhile has not left', async () => {
    const devices = Object.assign(new EventTarget(), { enumerateDevices: async () => [] });
    inBrowser('linux', devices);
    const context = new Context(8), output = await play(physvib, context, onRow(1)), states = statesOf(output);
    context.run(40);
    await null;
    const gone = context.currentTime;
    let back;
    context.resume = () => new Promise(done => { back = done; });
    devices.dispatchEvent(new Event('devicechange'));
    output.impact({ x: 0.5, y: 0.5 });
    context.run(40);
    await until(() => states.length > 0);
    assert.deepEqual(states, ['device lost']);
    context.run(40);
    await null;
    assert.equal(output.left(gone, context.currentTime)[0].frames, 0);
    assert.ok(output.left(0, gone)[0].running);
    context.resume = async () => {};
    back();
    await later(10);
    assert.deepEqual(states, ['device lost', 'running']);
    output.close();
    devices.dispatchEvent(new Event('devicechange'));
    // Without a device from the beginning, nobody answers.
    const none = new Context(0);
    none.state = 'suspended';
    none.resume = () => new Promise(() => {});
    const waiting = await play(physvib, none, onRow(1));
    assert.equal(waiting.state, 'suspended');
    navigator.userActivation = { hasBeenActive: false };
    assert.equal(await waiting.resume(), false);
    assert.equal(waiting.state, 'suspended', 'it waits for a click');
    navigator.userActivation.hasBeenActive = true;
    assert.equal(await waiting.resume(), false);
    assert.equal(waiting.state, 'device lost');
    none.state = 'running';
    none.resume = async () => {};
    await later(5);
    assert.equal(waiting.state, 'running');
    waiting.close();
});
