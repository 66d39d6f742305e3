// SPDX-License-Identifier: MIT
// Worlds from which nothing is felt, each for one reason: the explanation names it, in JavaScript's words. silent.mjs FOLDER, where npm has installed the package.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder] = process.argv.slice(2), physvib = await (await load(folder, 'physvib')).load();
const ball = { massKg: 2, isSource: true, frequencyHz: 200, decayPerSecond: 30 };
const met = { x: 0.5, y: 0.5, normalX: 0, normalY: -1, approach: 3 };

/** A floor (0), a ball (1) that is a haptic source, and a hit, but for what is changed. */
function hit({ settings, body, contact, seconds = 0.01, gravity = 9.81, touches = true } = {}) {
    const world = physvib.world(settings);
    world.setBody(0);
    world.setBody(1, { ...ball, ...body });
    world.step(seconds, gravity);
    world.step(seconds, gravity, () => { if (touches) world.touch(1, 0, { ...met, ...contact }); });
    return world;
}

function played(prepare, settings = { fieldWidth: 1, fieldHeight: 1 }) {
    const renderer = physvib.renderer(settings), world = hit();
    prepare(renderer);
    renderer.pull(64);
    world.send(renderer, 0, true);
    renderer.pull(64);
    return [world, renderer];
}

const noted = note => {
    const world = hit({ touches: false });
    world.note(1, note);
    return [world];
};

const reasons = {
    'never stepped': [() => [physvib.world()], '(beginStep and endStep)'],
    'step of 0 s': [() => [hit({ touches: false, seconds: 0 })], 'give beginStep the seconds'],
    'milliseconds': [() => [hit({ touches: false, seconds: 16.7 })], 'seconds, not milliseconds'],
    'no contact': [() => [hit({ touches: false })], 'not reported (touch)'],
    'no source': [() => [hit({ body: { isSource: false } })], 'set isSource'],
    'sensor': [() => noted('sensor'), 'body 1 is a sensor'],
    'filtered': [() => noted('filtered'), 'body 1 is filtered'],
    'disabled': [() => noted('disabled'), 'body 1 is disabled'],
    'asleep': [() => noted('asleep'), 'body 1 is asleep'],
    'both masses 0': [() => [hit({ body: { massKg: 0, staticMassKg: 2 } })], 'set massKg'],
    'normal reversed': [() => [hit({ contact: { approach: -3 } })], 'part along the reported normal'],
    'no speed': [() => [hit({ contact: { approach: null } })], 'set approach or impulse, or call move'],
    'below the threshold': [() => [hit({ contact: { approach: 0.08 } })], 'the strongest impact had 0.08 m/s): set threshold lower'],
    'pixels': [() => [hit({ contact: { x: 400 } })], 'set metresPerUnit'],
    'field not set': [() => [hit({ contact: { x: 3 } })], 'set fieldWidth'],
    'outside the field': [() => [hit({ settings: { fieldWidth: 2 }, contact: { x: 3 } })], 'outside the field of 2 m'],
    'outside the renderer\'s field': [() => played(() => {}, { fieldWidth: 0.3, fieldHeight: 0.3 }), 'set fieldWidth and fieldHeight of the renderer'],
    'muted': [() => [hit({ settings: { isMuted: true } })], 'set isMuted'],
    'gain of 0': [() => [hit({ body: { gain: 0 } })], 'gain of 0'],
    'no sound': [() => [hit({ body: { frequencyHz: 0, decayPerSecond: 0 } })], 'set frequencyHz and decayPerSecond'],
    'level of 0': [() => played(renderer => renderer.setLevel(0, 0)), 'level of the output is 0'],
    'channels muted': [() => played(renderer => [0, 1, 2, 3].forEach(j => renderer.setMute(0, j, true))), 'channels that play these places are muted'],
    'silence held': [() => played(renderer => renderer.silence(0, 1e10)), 'Silence is held by silence'],
    'no device': [() => [hit(), { isMissing: true }], 'No device plays the events'],
};
for (const [name, [make, said]] of Object.entries(reasons)) test(name, () => {
    const [world, output] = make(), why = world.explain(output);
    assert.ok(why.includes(said), `expected "${said}", found "${why}"`);
    world.free();
});

test('a body that was not set', () => {
    const world = hit({ touches: false });
    assert.throws(() => world.step(0.01, 9.81, () => world.touch(1, 7, met)), /body/);
    assert.match(world.explain(), /\(7\): call setBody/);
});

test('what is silent now', () => {
    const world = hit();
    assert.match(world.explain(), /1 event was made/);
    world.step(0.01, 9.81);
    assert.match(world.explain(), /^No contact has begun in 1 step/);
    assert.match(world.explain(), /^Nothing was stepped since the last explanation; before: 1 event/);
});
