// SPDX-License-Identifier: MIT
// The audio thread's file in a stub of a page's: audio.mjs FOLDER. Its samples are those of render, at the times that the page gives them.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import test from 'node:test';
import vm from 'node:vm';
import { load } from './installed.mjs';

const folder = resolve(process.argv[2]), rate = 48000, quantum = 128;
const physvib = await (await load(folder, 'physvib')).load(), { play } = await load(folder, 'physvib/audio');
const code = readFileSync(createRequire(join(folder, 'index.js')).resolve('physvib/worklet.js'), 'utf8');

/** An audio context whose quanta the test pulls. */
class Context {
    frame = 0; sampleRate = rate; recorded = [];
    constructor(outputs) {
        this.destination = { maxChannelCount: outputs, channelCount: 2 };
        this.audioWorklet = { addModule: async () => { this.global = this.makeGlobal(); } };
    }
    get currentTime() { return this.frame / rate; }
    makeGlobal() {
        const context = this;
        const global = vm.createContext({ WebAssembly, sampleRate: rate, AudioWorkletProcessor: class { constructor() { this.port = context.port; } },
            registerProcessor: (name, processor) => { context.Processor = processor; }, get currentFrame() { return context.frame; } });
        vm.runInContext(code, global);
        return global;
    }
    run(quanta) {
        for (let i = 0; i < quanta; ++i) {
            const out = Array.from({ length: this.outputs }, () => new Float32Array(quantum));
            this.isAlive = this.processor.process([], [out]);
            out.forEach((channel, j) => (this.recorded[j] ??= []).push(...channel));
            this.frame += quantum;
        }
    }
}
const told = [];
class Node {
    constructor(context) { this.context = context; this.gain = { setTargetAtTime: value => { this.level = value; } }; }
    connect(to) { told.push([this.constructor.name, to.constructor.name]); return to; }
    disconnect() {}
}
globalThis.GainNode = class GainNode extends Node {};
globalThis.ChannelSplitterNode = class ChannelSplitterNode extends Node {};
globalThis.StereoPannerNode = class StereoPannerNode extends Node { constructor(context, { pan }) { super(context); told.push(pan); } };
globalThis.AudioWorkletNode = class AudioWorkletNode extends Node {
    constructor(context, name, { outputChannelCount, processorOptions }) {
        super(context);
        const inside = { postMessage: data => queueMicrotask(() => this.port.onmessage({ data })) };
        this.port = { postMessage: data => inside.onmessage({ data: structuredClone(data) }) };
        context.port = inside;
        [context.outputs] = outputChannelCount;
        context.processor = new context.Processor({ processorOptions });
    }
};

test('a game at a variable rate is felt with constant latency, as render has it', async () => {
    told.length = 0;
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

test('two outputs: a stereo monitor, each actuator at its place; gains, mutes and silence arrive', async () => {
    told.length = 0;
    const context = new Context(2), output = await play(physvib, context, { layout: 'phone2', fieldWidth: 1, fieldHeight: 1 });
    assert.ok(!output.isDirect && told.includes(-1) && told.includes(1), JSON.stringify(told));
    context.run(1);
    output.setMute(0, true);
    output.strike([{ timeNs: 0, frequencyHz: 100, decayPerSecond: 20, amplitude: 0.5, x: 0.5, y: 0.5 }]);
    context.run(100);
    assert.ok(context.recorded[0].slice(1000).every(sample => sample === 0) && context.recorded[1].some(sample => sample !== 0));
    const before = context.recorded[1].length;
    output.impact({ x: 1, y: 0.5, strength: 0.8, material: 'wooden board' });
    context.run(100);
    assert.ok(Math.max(...context.recorded[1].slice(before)) > 0.1);
    output.silence();
    context.run(20);
    assert.ok(context.recorded[1].slice(-quantum).every(sample => sample === 0));
    output.setLayout({ layout: 'phone1' });
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
    const hit = (x = 0.5) => {
        world.step(0.01, 9.81, () => world.touch(1, 0, { x, y: 0.5, normalX: 0, normalY: -1, approach: 3 }));
        return world.explain(output);
    };
    world.setBody(0);
    world.setBody(1, { massKg: 2, isSource: true, frequencyHz: 200, decayPerSecond: 30 });
    world.step(0.01, 9.81);
    const again = said => { world.step(0.01, 9.81); assert.match(hit(), said); };
    assert.match(hit(), /and reach the output/);
    for (let j = 0; j < 4; ++j) output.setMute(j, true);
    again(/channels that play these places are muted/);
    for (let j = 0; j < 4; ++j) output.setMute(j, false);
    again(/and reach the output/);
    output.setLevel(0);
    again(/level of the output is 0/);
    output.setLevel(0.5);
    output.setLayout({ fieldWidth: 0.1, fieldHeight: 0.1 });
    again(/set fieldWidth and fieldHeight of the renderer/);
    output.setLayout({ fieldWidth: 1, fieldHeight: 1 });
    context.state = 'suspended';
    again(/^The AudioContext is suspended: call resume\(\) in a click\. 1 event/);
    context.state = 'running';
    again(/^1 event/);
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
    await refused({ latncy: 0.06 }, /^latncy: expected one of .*fieldWidth.*, latency, level, worklet$/);
    await assert.rejects(play(Promise.resolve(physvib), new Context(8)), { message: 'play: expected the library (await load()), found Promise' });
    const output = await play(physvib, new Context(8), { latency: 0, level: 1 });
    assert.throws(() => output.setLevel(50), /level: expected 0 to 1, found 50/);
    assert.throws(() => output.setLayout({ layout: 'phone4', law: 'none' }), /law/);
    output.setLayout({ layout: 'phone2' });
});

test('a page without audio worklets says why', async () => {
    globalThis.isSecureContext = false;
    await assert.rejects(play(physvib, {}), /https/);
});
