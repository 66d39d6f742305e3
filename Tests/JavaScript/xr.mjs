// SPDX-License-Identifier: MIT
// Pulses of WebXR's controllers by IWER, an emulated headset that keeps them: xr.mjs FOLDER.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './installed.mjs';

// It makes elements of a page, which no test looks at.
const anything = new Proxy(function () {}, { get: (_, name) => (name === Symbol.toPrimitive ? () => 0 : anything), set: () => true, apply: () => anything, construct: () => anything });
globalThis.document = anything;
const [folder] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load(), { hands } = await load(folder, 'physvib/xr'), { XRDevice, metaQuest3 } = await load(folder, 'iwer');

/** A headset whose time goes as the test says: every pulse of both hands. */
class Headset {
    ms = 0; timers = new Map(); pulses = []; next = 0; lateMs = 0; // a busy page calls back later
    constructor() {
        this.device = new XRDevice(metaQuest3);
        this.session = { inputSources: this.device.inputSources };
        for (const { handedness, gamepad } of this.session.inputSources) for (const actuator of gamepad?.hapticActuators ?? []) {
            const pulse = actuator.pulse.bind(actuator);
            actuator.pulse = (value, ms) => { const done = pulse(value, ms); this.pulses.push({ ms: this.ms, hand: handedness, value, length: ms }); return done; };
        }
        this.system = { now: () => this.ms, setTimeout: (call, ms) => { this.timers.set(++this.next, { at: this.ms + ms + this.lateMs, call }); return this.next; }, clearTimeout: timer => this.timers.delete(timer) };
    }
    run(until) {
        for (;;) {
            const [first] = [...this.timers].sort(([, a], [, b]) => a.at - b.at);
            if (!first || first[1].at > until) break;
            this.timers.delete(first[0]);
            this.ms = Math.max(this.ms, first[1].at);
            first[1].call();
        }
        this.ms = until;
    }
    of(hand) { return this.pulses.filter(pulse => pulse.hand === hand); }
    /** What is felt at a time: the last pulse, if it still lasts. */
    at(hand, ms) { const last = this.of(hand).filter(pulse => pulse.ms <= ms).at(-1); return last && ms < last.ms + last.length ? last.value : 0; }
}
const hit = (ms, amplitude, more = {}) => ({ timeNs: ms * 1e6, durationNs: 0, frequencyHz: 80, decayPerSecond: 30, amplitude, x: 0.5, y: 0.5, kind: 'hit', ...more });

test('IWER has two hands with an actuator each, and keeps the last pulse', () => {
    const headset = new Headset(), felt = hands(physvib, headset.session, headset.system);
    assert.deepEqual([...headset.session.inputSources].filter(({ gamepad }) => gamepad?.hapticActuators.length === 1).map(({ handedness }) => handedness).sort(), ['left', 'right']);
    felt.strike('left', [hit(10, 1)], 0);
    headset.run(50);
    assert.ok(headset.of('left').length > 0 && headset.of('right').length === 0);
    felt.close();
});

test('each hit is felt on the hand that made it', () => {
    const headset = new Headset(), world = physvib.world({ fieldWidth: 2, fieldHeight: 2, fullScaleImpulse: 1 }), followers = new Set();
    const haptics = { id: body => body.id, follow(follower) { followers.add(follower); return () => followers.delete(follower); } };
    const felt = hands(physvib, () => headset.session, { ...headset.system, latency: 0.02 }), end = felt.follow(haptics, { left: [{ id: 1 }], right: { id: 2 } });
    const step = events => { headset.run(headset.ms + 16); for (const follower of followers) follower(events, { timeNs: headset.ms * 1e6 }); };
    step([]);
    step([hit(30, 1, { fixture: 1, other: 9 })]);
    for (let i = 0; i < 40; ++i) step([]);
    const lefts = headset.of('left').filter(({ value }) => value > 0).length;
    assert.ok(lefts > 0 && headset.of('right').every(({ value }) => value === 0), 'the left one alone');
    step([hit(headset.ms, 0.5, { fixture: 9, other: 2 }), hit(headset.ms, 1, { fixture: 8, other: 9 })]);
    for (let i = 0; i < 40; ++i) step([]);
    const rights = headset.of('right').filter(({ value }) => value > 0);
    assert.ok(rights.length > 0 && headset.of('left').filter(({ value }) => value > 0).length === lefts, 'the right one alone; what touches no hand is not felt');
    assert.ok(Math.max(...rights.map(({ value }) => value)) < Math.max(...headset.of('left').map(({ value }) => value)), 'the weaker is weaker');
    end();
    assert.equal(followers.size, 0);
    assert.throws(() => felt.follow(haptics, { foot: { id: 1 } }), /follow: expected left, right/);
    felt.close();
    world.free();
});

test('a busy page passes no hit over, and ends it', () => {
    const play = (lateMs, amplitude) => {
        const headset = Object.assign(new Headset(), { lateMs }), felt = hands(physvib, headset.session, headset.system);
        felt.strike('right', [hit(20, amplitude, { decayPerSecond: 107 })], 0);
        headset.run(1500);
        return headset.of('right').map(({ value }) => value);
    };
    for (const amplitude of [0.5, 0.1]) for (const lateMs of [10, 20, 40, 100]) {
        const pulses = play(lateMs, amplitude), most = Math.max(...play(0, amplitude));
        assert.ok(most > 0 && Math.max(...pulses) === most, `${lateMs} ms late, ${amplitude}: ${pulses} instead of ${most} at first`);
        assert.equal(pulses.at(-1), 0, 'it ends');
    }
});

test('a weak hit never ends a strong one, and silence is silence', () => {
    const play = hits => { const headset = new Headset(), felt = hands(physvib, headset.session, headset.system); felt.strike('right', hits, 0); headset.run(1500); return headset; };
    const alone = play([hit(20, 1)]), with_ = play([hit(20, 1), ...Array.from({ length: 20 }, (_, i) => hit(30 + 10 * i, 0.02))]);
    for (let ms = 22; ms < 400; ms += 2) assert.ok(with_.at('right', ms) >= alone.at('right', ms) - 0.011, `at ${ms} ms: ${with_.at('right', ms)} instead of ${alone.at('right', ms)}`);
    assert.equal(alone.of('right').at(-1).value, 0, 'it ends');
    const headset = new Headset(), felt = hands(physvib, headset.session, headset.system);
    felt.strike('right', [hit(20, 1), hit(40, 1)], 0);
    headset.run(60);
    felt.stop();
    const count = headset.pulses.length;
    headset.run(2000);
    assert.ok(headset.pulses.slice(count).every(({ value }) => value === 0), 'no pulse after silence');
    assert.equal(headset.at('right', 100), 0);
    felt.close();
});

test('a session that is not there yet, hands without actuators, a level', () => {
    const headset = new Headset();
    let session = null;
    const felt = hands(physvib, () => session, headset.system);
    felt.strike('left', [hit(10, 1)], 0);
    headset.run(100);
    assert.equal(headset.pulses.length, 0);
    session = { inputSources: [{ handedness: 'left', gamepad: null }, { handedness: 'left', gamepad: {} }] };
    felt.strike('left', [hit(110, 1)], 0);
    headset.run(1000);
    ({ session } = headset);
    felt.setLevel(0);
    felt.strike('left', [hit(1010, 1)], 0);
    headset.run(2000);
    assert.ok(headset.pulses.every(({ value }) => value === 0));
    felt.close();
});
