// SPDX-License-Identifier: MIT
// React Three Fiber: a ball that falls within <Physics>, which makes the steps: react.mjs FOLDER. What it renders with draws nothing.
import assert from 'node:assert/strict';
import test from 'node:test';
import { load } from './installed.mjs';

const [folder] = process.argv.slice(2), [{ createElement: h, act, useMemo }, { create }, Rapier, { Felt, useSource }] = await Promise.all(['react', '@react-three/test-renderer', '@react-three/rapier', 'physvib/react'].map(name => load(folder, name).then(module => ({ ...module.default, ...module }))));
const { Physics, RigidBody, BallCollider, CuboidCollider } = Rapier;
globalThis.IS_REACT_ACT_ENVIRONMENT = true;
const rate = 60, massKg = 0.2, height = 0.8, radius = 0.1;

function Ball({ material, ...props }) { return h(RigidBody, { ref: useSource(material), colliders: false, position: [0, height + radius, 0], ...props }, h(BallCollider, { args: [radius], mass: massKg, restitution: 0.5, restitutionCombineRule: 3 })); }
const floor = h(RigidBody, { key: 'floor', type: 'fixed', colliders: false }, h(CuboidCollider, { args: [5, 0.5, 5], position: [0, -0.5, 0], restitution: 0.5, restitutionCombineRule: 3 }));
/** A scene by its children in <Felt>; what `of` makes of it and of what is felt. */
async function scene(props, children, of) {
    let felt = null, world;
    const ready = new Promise(done => { world = h(Physics, { timeStep: 1 / rate, gravity: [0, -9.81, 0] }, floor, h(Felt, { fullScaleImpulse: 1, fieldWidth: 4, fieldHeight: 3, fieldX: -2, ...props, onReady: made => { felt = made; done(); } }, children)); });
    const renderer = await create(h('group', null, h((await load(folder, 'react')).Suspense, { fallback: null }, world)));
    for (let i = 0; i < 400 && !felt; ++i) await act(() => new Promise(next => setTimeout(next, 5)));
    await ready;
    const run = seconds => act(async () => { await renderer.advanceFrames(Math.round(seconds * rate), 1 / rate); });
    await of({ felt, run, renderer });
}

test('a bounce within <Physics> is one hit, as strong as its own velocities say', () => scene({}, h(Ball, { material: 'wooden board' }), async ({ felt, run, renderer }) => {
    const speeds = [], { body } = [...felt.haptics.each()].find(({ isStatic }) => !isStatic), frames = 42;
    for (let i = 0; i < frames; ++i) {
        await run(1 / rate);
        speeds.push(body.linvel().y);
    }
    const change = Math.max(...speeds.slice(1).map((speed, i) => speed - speeds[i])), [least, most] = [massKg * change, massKg * (change + 9.81 / rate)], hits = felt.haptics.take(true).filter(({ kind }) => kind === 'hit'), [first] = hits;
    assert.equal(hits.length, 1, felt.explain());
    assert.ok(first.impulse > 0.98 * least && first.impulse < 1.02 * most, `${first.impulse} N s, due ${least.toFixed(3)} to ${most.toFixed(3)}`);
    console.log(`React Three Fiber: ${first.impulse.toFixed(4)} N s, its own ${least.toFixed(4)} to ${most.toFixed(4)}, paper ${(massKg * Math.sqrt(2 * 9.81 * height) * 1.5).toFixed(4)}; felt at ${(first.timeNs * 1e-6).toFixed(1)} ms`);
    await act(() => renderer.unmount());
    assert.throws(() => felt.haptics.set({}, {}), 'it is closed with the scene');
}));

test('what is no source is not felt', () => scene({}, h(RigidBody, { colliders: false, position: [0, 1, 0] }, h(BallCollider, { args: [radius] })), async ({ felt, run }) => {
    await run(0.7);
    assert.equal(felt.haptics.take(true).length, 0);
    assert.match(felt.explain(), /source/);
}));

test('each of several instances is felt, and what an object names is a source', () => {
    const { InstancedRigidBodies } = Rapier;
    function Balls() {
        const ref = useSource({ material: 'steel plate' }), instances = useMemo(() => [-1, 1].map((x, key) => ({ key, position: [x, height + radius, 0] })), []);
        return h(InstancedRigidBodies, { ref, instances, colliders: false, colliderNodes: [h(BallCollider, { key: 0, args: [radius], mass: massKg })] }, h('instancedMesh', { args: [undefined, undefined, 2], count: 2 }));
    }
    return scene({}, h(Balls), async ({ felt, run }) => {
        await run(0.7);
        assert.equal(new Set(felt.haptics.take(true).map(({ x }) => Math.round(x))).size, 2, felt.explain());
    });
});

test('a material that is none, and a source outside <Felt>, are told, and the scene goes on', async () => {
    const { error } = console, lines = [];
    console.error = line => lines.push(String(line));
    try {
        await scene({}, [h(Ball, { key: 'odd', material: 'wood of nobody', position: [1, 1, 0] }), h(Ball, { key: 'good', material: 'wooden board' })], async ({ felt, run }) => {
            await run(0.7);
            assert.ok(felt.haptics.take(true).length > 0, felt.explain());
        });
        const renderer = await create(h('group', null, h((await load(folder, 'react')).Suspense, { fallback: null }, h(Physics, null, h(Ball, { material: 'wooden board' })))));
        for (let i = 0; i < 100 && !lines.some(line => /outside of <Felt>/.test(line)); ++i) await act(() => new Promise(next => setTimeout(next, 5)));
        await act(() => renderer.unmount());
    } finally {
        console.error = error;
    }
    for (const found of [/PhysVib: nothing is felt, the scene goes on: material: expected one that vibrates/, /useSource is outside of <Felt>/]) assert.ok(lines.some(line => found.test(line)), lines.join('\n'));
});
