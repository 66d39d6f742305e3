// SPDX-License-Identifier: MIT
// What motors of controllers would get, by stubs of what browsers have: pads.mjs FOLDER PHYSVIB. The native program's commands are the measure.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder, native] = process.argv.slice(2).map(path => resolve(path));
const physvib = await (await load(folder, 'physvib')).load(), { rumble } = await load(folder, 'physvib/gamepad');
const work = mkdtempSync(join(tmpdir(), 'physvib-'));

/** A page whose time goes as the test says, with one controller. */
class Page {
    ms = 0; timer = null; sent = []; phone = []; answer = 'complete';
    constructor(effects = ['dual-rumble']) {
        const page = this;
        this.pad = { connected: true, vibrationActuator: { effects,
            playEffect(effect, { duration, strongMagnitude, weakMagnitude, leftTrigger = 0 }) { page.sent.push({ ms: page.ms, effect, duration, low: strongMagnitude, high: weakMagnitude, leftTrigger }); return Promise.resolve(page.answer); },
            reset() { page.sent.push({ ms: page.ms, effect: 'reset', low: 0, high: 0 }); return Promise.resolve('complete'); } } };
        this.system = { now: () => this.ms, getGamepads: () => [null, this.pad], vibrate: ms => this.phone.push(ms),
            setTimeout: (call, ms) => (this.timer = { at: this.ms + ms, call }), clearTimeout: () => { this.timer = null; } };
    }
    /** To that time, timer by timer. */
    run(untilMs) {
        while (this.timer && this.timer.at <= untilMs) {
            const { at, call } = this.timer;
            this.timer = null;
            this.ms = Math.max(this.ms, at);
            call();
        }
        this.ms = untilMs;
    }
}
const hit = (ms, amplitude, more = {}) => ({ timeNs: ms * 1e6, durationNs: 0, frequencyHz: 80, decayPerSecond: 30, amplitude, x: 0.5, y: 0.5, kind: 'hit', ...more });

test('ten seconds of shake-the-box: the commands of the native sink', async () => {
    execFileSync(native, ['render', 'shake-the-box', '--seconds', '10', '--events', 'box.csv', '--out', 'box.wav'], { cwd: work });
    const text = readFileSync(join(work, 'box.csv'), 'utf8'), events = await physvib.parseEvents(text), page = new Page();
    execFileSync(native, ['render', '--from-events', 'box.csv', '--seconds', '10', '--field', '1,1', '--pad', 'pad-generic', '--out', 'motors.csv'], { cwd: work });
    const wanted = readFileSync(join(work, 'motors.csv'), 'utf8').split('\n').filter(line => /^\d/.test(line)).map(line => line.split(',').map(Number));
    const motors = physvib.pad('pad-generic'), found = [];
    for (const event of events) {
        while (motors.dueNs < event.timeNs - 3e7) found.push(motors.next());
        motors.strike(event);
    }
    while (motors.dueNs < 10e9) found.push(motors.next());
    const changes = found.filter((command, i) => i === 0 || command.low !== found[i - 1].low || command.high !== found[i - 1].high);
    assert.ok(wanted.length > 100, `${wanted.length} commands`);
    wanted.slice(1, -1).forEach(([seconds, low, high], i) => // it begins and ends with rest
         assert.deepEqual([changes[i].low, changes[i].high, Math.round(changes[i].timeNs)], [low, high, Math.round(seconds * 1e9)], `command ${i}`));
    const pads = rumble(physvib, page.system);
    pads.strike(events, 0);
    page.run(12000);
    assert.ok(page.sent.length > 100 && page.sent.length <= 12 * 30 + 2, `${page.sent.length} commands in 12 s`);
    const gaps = page.sent.slice(1).map((command, i) => command.ms - page.sent[i].ms);
    assert.ok(Math.min(...gaps) >= 33, `two commands within ${Math.min(...gaps)} ms`);
    assert.equal(page.timer, null, 'motors that are at rest take no timer');
    assert.deepEqual([page.sent.at(-1).low, page.sent.at(-1).high], [0, 0]);
});

test('60 hits a second: every one adds to what is felt, none is dropped', () => {
    const page = new Page(), pads = rumble(physvib, page.system);
    pads.strike(Array.from({ length: 120 }, (_, i) => hit(100 + i * 1000 / 60, 0.05)), 0);
    page.run(1900);
    const strong = page.sent.filter(command => command.ms > 600).map(command => command.low);
    assert.ok(Math.min(...strong) > 0.3, `a motor stood still: ${Math.min(...strong)}`);
    assert.equal(pads.lost, 0);
    assert.ok(page.sent.every(command => command.effect === 'reset' || command.duration >= 100), 'each lasts until the next');
    pads.close();
});

test('a soft hit after a hard one leaves it as strong as it is', () => {
    const felt = hits => {
        const page = new Page(), pads = rumble(physvib, page.system);
        pads.strike(hits, 0);
        page.run(1000);
        return page.sent.map(({ ms, low }) => [Math.round(ms), low]);
    };
    const alone = felt([hit(100, 1)]), both = felt([hit(100, 1), hit(130, 0.02)]);
    alone.forEach(([ms, low], i) => assert.ok(both[i][1] >= low, `at ${ms} ms: ${both[i][1]} instead of ${low}`));
});

test('triggers, phones, silence, refusals', async () => {
    const page = new Page(['dual-rumble', 'trigger-rumble']), pads = rumble(physvib, page.system);
    page.answer = 'invalid';
    pads.strike([hit(10, 1)], 0);
    page.run(60);
    await null;
    assert.ok(page.sent[0].effect === 'trigger-rumble' && page.sent[0].leftTrigger > 0 && page.phone[0] >= 10 && pads.refused > 0);
    pads.stop();
    assert.equal(page.sent.at(-1).effect, 'reset');
    assert.equal(page.phone.at(-1), 0);
    const count = page.sent.length;
    page.run(2000);
    assert.ok(page.sent.slice(count).every(command => command.low === 0 && command.high === 0));
    assert.throws(() => rumble(physvib, { profile: 'mine' }), /pad-generic/);
    assert.throws(() => rumble(physvib, { profile: { low: {}, high: {} } }), /threshold/);
    assert.throws(() => rumble(Promise.resolve(physvib)), { message: 'rumble: expected the library (await load())' });
    assert.throws(() => rumble(physvib, { profle: 'pad-xbox' }), { message: 'profle: expected one of profile, latency, level, fieldWidth, fieldHeight, phone' });
    for (const level of [-1, NaN]) assert.throws(() => rumble(physvib, { level }), { message: `level: expected 0 or more, found ${level}` });
    assert.throws(() => rumble(physvib, { latency: -1 }), { message: 'latency: expected 0 to 10 s, found -1' });
});

test('what an engine feels is felt with constant latency, however its frames fall', () => {
    const page = new Page(), pads = rumble(physvib, { latency: 0.1, ...page.system }), followers = new Set();
    const haptics = { follow(follower) { followers.add(follower); return () => followers.delete(follower); } };
    const end = pads.follow(haptics);
    let worldMs = 0;
    for (const frame of [10, 20, 16, 30, 16, 16, 20, 16]) {
        page.run(page.ms + frame);
        worldMs += 16;
        for (const follower of followers) follower(worldMs === 80 ? [hit(70, 1)] : [], { timeNs: worldMs * 1e6 });
    }
    page.run(page.ms + 300);
    const [first] = page.sent, start = (-6 - 2 - 2 + 12) / 4; // ms: the middle of the frames that have ended
    assert.ok(Math.abs(first.ms - (70 + start + 100 - 30)) < 1, `felt at ${first.ms}`); // motors begin 30 ms before
    end();
    assert.equal(followers.size, 0);
});

test('two worlds of other ages: each hit is felt at its time', () => {
    const page = new Page(), pads = rumble(physvib, page.system), followers = [], due = [];
    const add = () => pads.follow({ follow: follower => { followers.push({ follower, ms: 0 }); return () => {}; } });
    add();
    for (let step = 0; step < 900; ++step) {
        page.run(page.ms + 16);
        if (step === 400) add();
        for (const [j, one] of followers.entries()) {
            const isHit = step > 500 && step % 50 === 25 * j;
            if (isHit) due.push(page.ms);
            one.follower(isHit ? [hit(one.ms, 1)] : [], { timeNs: (one.ms += 16) * 1e6 });
        }
    }
    page.run(page.ms + 8000);
    const starts = page.sent.filter(({ low }, i) => low > 0.3 && !(page.sent[i - 1]?.low > 0.3)).map(({ ms }) => ms);
    assert.deepEqual(starts.map((ms, i) => ms - due[i] >= 0 && ms - due[i] < 100), due.map(() => true), `${starts} for ${due}`);
    pads.close();
});

/** A page whose controller plays samples, or says that it does not. */
function wavePage(answer) {
    const page = new Page(), buffers = [];
    page.pad.vibrationActuator.playPCM = sound => { buffers.push({ ms: page.ms, ...sound }); return Promise.resolve(answer); };
    page.system.audioBuffer = ({ length, sampleRate, numberOfChannels }) => ({ length, sampleRate, numberOfChannels, copyToChannel(samples) { this.samples = samples; } });
    return { page, buffers };
}

test('a controller that plays samples gets them, and no commands: every hit in each buffer, at its time', async () => {
    const { page, buffers } = wavePage(true), pads = rumble(physvib, { ...page.system, level: 0.5 }), hits = [hit(60, 1), hit(130, 0.2, { frequencyHz: 200 })];
    pads.strike(hits.slice(0, 1), 0);
    page.run(100);
    pads.strike(hits.slice(1), 0);
    page.run(1000);
    await null;
    assert.deepEqual(buffers.map(({ ms, length, sampleRate, numberOfChannels }) => [ms, length, sampleRate, numberOfChannels]), [[0, 8000, 8000, 1], [100, 8000, 8000, 1]]);
    const whole = physvib.render(hits, { seconds: 1.1, rate: 8000, layout: 'phone1', fieldWidth: 1, fieldHeight: 1 })[0].map(sample => sample * 0.5);
    const first = buffers[0].samples.findIndex(sample => sample !== 0) / 8;
    assert.ok(first >= 60 && first < 60.3, `the first sample at ${first} ms`);
    const off = buffers[1].samples.reduce((most, sample, n) => Math.max(most, Math.abs(sample - whole[n + 800])), 0);
    assert.ok(off < 1e-3, `the second buffer is off by ${off}`);
    assert.equal(page.sent.length, 0, 'its motors would end the samples');
    pads.stop();
    assert.deepEqual([...buffers.at(-1).samples], [0]);
    pads.close();
});

test('a stream of hits sends no more than thirty buffers a second', () => {
    const { page, buffers } = wavePage(true), pads = rumble(physvib, page.system);
    for (let ms = 0; ms < 1000; ms += 4) {
        page.run(ms);
        pads.strike([hit(ms + 60, 0.1)], 0);
    }
    assert.ok(buffers.length > 20 && buffers.length <= 32, `${buffers.length} buffers`);
    pads.close();
});

test('one that refuses samples is driven by its motors from then on', async () => {
    const { page, buffers } = wavePage(false), pads = rumble(physvib, page.system);
    pads.strike([hit(40, 1)], 0);
    await null;
    await null;
    page.run(500);
    assert.ok(buffers.length === 1 && page.sent.some(command => command.low > 0.3));
    pads.strike([hit(600, 1)], 0);
    assert.equal(buffers.length, 1);
    pads.close();
});
