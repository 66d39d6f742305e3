// SPDX-License-Identifier: MIT
// All of it by one call, in each engine: feel.mjs FOLDER. In Node nothing plays; a stub of a page's context does.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import test, { after } from 'node:test';
import { Context as Fake } from './fake-audio.mjs';
import { load } from './installed.mjs';

const folder = resolve(process.argv[2]), { feel: begin } = await load(folder, 'physvib/feel'), opened = [], at = createRequire(join(folder, 'index.js')), worklet = readFileSync(at.resolve('physvib/worklet.js'), 'utf8');
const { default: Matter } = await load(folder, 'matter-js'), physvib = await (await load(folder, 'physvib')).load(), { material } = await load(folder, 'physvib');
const field = { pixelsPerMetre: 200, fieldWidth: 4, fieldHeight: 3 };
async function feel(...given) {
    const felt = await begin(...given);
    opened.push(felt);
    return felt;
}
after(() => { for (const felt of opened) try { felt.output?.close(); felt.close(); } catch { /* it has ended */ } }); // what looks for devices ends
/** A ball that falls for 0.7 s. */
function game() {
    const engine = Matter.Engine.create(), ball = Matter.Bodies.circle(200, 300, 20);
    Matter.Composite.add(engine.world, [Matter.Bodies.rectangle(400, 590, 800, 20, { isStatic: true }), ball]);
    return { engine, ball, step: () => Matter.Engine.update(engine, 1000 / 240) };
}
class Context extends Fake {
    static made = [];
    isClosed = false;
    constructor() {
        super(worklet, 8);
        this.state = 'suspended';
        Context.made.push(this);
    }
    async close() { this.isClosed = true; }
}
const until = async holds => { for (const began = performance.now(); !holds() && performance.now() - began < 30000;) await new Promise(done => setTimeout(done, 5)); }; // what then must hold is asserted
/** A page, as long as `act` goes on. */
async function onPage(navigator, act, AudioContext = Context) {
    const before = Object.getOwnPropertyDescriptor(globalThis, 'navigator'), { error } = console, lines = [];
    Object.defineProperty(globalThis, 'navigator', { configurable: true, value: { userAgent: 'X11; Linux', ...navigator } });
    Object.assign(globalThis, { document: Object.assign(new EventTarget(), { baseURI: 'https://example.org/' }), AudioContext });
    Context.made = [];
    console.error = line => lines.push(line);
    try { await act(name => document.dispatchEvent(new Event(name)), lines); } finally {
        console.error = error;
        if (before) Object.defineProperty(globalThis, 'navigator', before); else delete globalThis.navigator;
        delete globalThis.document;
        delete globalThis.AudioContext;
    }
}

test('Matter: a ball of a material is felt, and close() ends it', async () => {
    const { engine, ball, step } = game(), felt = await feel(engine, field);
    felt.set(ball, 'wooden board');
    for (let i = 0; i < 240; ++i) step();
    const events = felt.haptics.take(true), { frequencyHz } = material('wooden board');
    assert.ok(events.length > 0 && events.every(event => event.frequencyHz === frequencyHz), felt.explain());
    assert.ok(Math.abs(events[0].x - 1) < 0.01 && Math.abs(events[0].y - 0.1) < 0.01, 'metres of the field');
    assert.ok(Math.abs(events[0].amplitude - 0.5) < 0.01, 'the level is set by what happens');
    assert.equal(felt.output, null);
    assert.match(felt.explain(), /^Nothing plays before the first click or key\./);
    assert.throws(() => felt.set(ball, 'cheese'), /material: expected one that vibrates/);
    felt.close();
    felt.close();
    assert.deepEqual(Object.values(engine.events).flat(), [], 'nothing is left in the engine');
    step();
    assert.throws(() => felt.set(ball, 'wooden board'));
});

test('other engines are known, and what is none is refused', async () => {
    const planck = await load(folder, 'planck').then(module => module.default ?? module), worlds = [['PlanckHaptics', new planck.World()], ['VelocityHaptics', { bodies: () => [], read() {} }]];
    for (const [kind, name] of [['2d', 'RapierHaptics'], ['3d', 'RapierHaptics3D']]) {
        const { default: R } = await load(folder, `@dimforge/rapier${kind}-compat`);
        await R.init();
        worlds.push([name, new R.World({ x: 0, y: -9.81, ...(kind === '3d' && { z: 0 }) })]);
    }
    const b2 = await (await import(pathToFileURL(join(folder, 'node_modules/box2d3-wasm/build/dist/es/entry.mjs')))).default();
    worlds.push(['Box2d3Haptics', b2.b2CreateWorld(b2.b2DefaultWorldDef()), { b2 }]);
    const cannon = await load(folder, 'cannon-es'), havok = await (await load(folder, '@babylonjs/havok')).default({ wasmBinary: readFileSync(join(folder, 'node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm')) });
    worlds.push(['CannonHaptics', new cannon.World()], ['HavokHaptics', { havok, world: havok.HP_World_Create()[1], bodies: () => [] }]);
    const mujoco = await (await load(folder, '@mujoco/mujoco')).default(), model = mujoco.MjModel.from_xml_string('<mujoco/>');
    worlds.push(['MujocoHaptics', { mujoco, model, data: new mujoco.MjData(model) }]);
    for (const [name, world, options] of worlds) {
        const felt = await feel(world, options);
        assert.equal(felt.haptics.constructor.name, name);
        felt.update?.(1 / 60);
        assert.equal(felt.haptics.error, null);
        felt.close();
    }
    await assert.rejects(feel({}), /feel: expected an engine's world/);
    await assert.rejects(feel(worlds[0][1], { feildWidth: 1 }), /feildWidth/);
});

test('Havok: a bounce off a floor that moves is whole', async () => {
    const havok = await (await load(folder, '@babylonjs/havok')).default({ wasmBinary: readFileSync(join(folder, 'node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm')) }), { MAXIMUM } = havok.MaterialCombine, noTurn = [0, 0, 0, 1];
    for (const rise of [0, 0.03, 0.5, -0.5]) {
        const [, world] = havok.HP_World_Create(), still = [0, 0, 0], e = 0.5, massKg = 0.2;
        havok.HP_World_SetGravity(world, [0, -9.81, 0]);
        const [floor, ball] = [[havok.HP_Shape_CreateBox(still, noTurn, [10, 1, 10])[1], 'KINEMATIC', -0.5], [havok.HP_Shape_CreateSphere(still, 0.1)[1], 'DYNAMIC', 0.9]].map(([shape, kind, y]) => {
            const [, body] = havok.HP_Body_Create(), [centre, mass, inertia, turn] = havok.HP_Shape_BuildMassProperties(shape)[1];
            havok.HP_Shape_SetMaterial(shape, [0, 0, e, MAXIMUM, MAXIMUM]);
            havok.HP_Body_SetShape(body, shape);
            havok.HP_Body_SetMotionType(body, havok.MotionType[kind]);
            if (kind === 'DYNAMIC') havok.HP_Body_SetMassProperties(body, [centre, massKg, inertia.map(one => one * massKg / mass), turn]);
            havok.HP_Body_SetQTransform(body, [[0, y, 0], noTurn]);
            havok.HP_World_AddBody(world, body, false);
            return body;
        });
        const felt = await feel({ havok, world, bodies: () => [floor, ball] }, { fieldWidth: 4, fieldHeight: 3, fieldX: -2, fullScaleImpulse: 1 });
        felt.set(ball, 'wooden board');
        for (let i = 1; i <= 40; ++i) {
            havok.HP_Body_SetTargetQTransform(floor, [[0, -0.5 + rise * i / 60, 0], noTurn]);
            felt.update(1 / 60);
        }
        const [{ impulse }] = felt.haptics.take(true), due = massKg * Math.sqrt(2 * 9.81 * 0.8 + rise ** 2) * (1 + e);
        assert.ok(Math.abs(impulse / due - 1) < 0.02, `${rise} m/s: ${impulse} N s, due ${due}`);
        felt.close();
    }
});

/** Steps until the ball has bounced; the sum of what actuators get. */
function heard({ step }, context) {
    for (let i = 0; i < 300; ++i) {
        step();
        context.run(1 + i % 2);
    }
    return context.recorded.flat().reduce((sum, sample) => sum + Math.abs(sample), 0);
}

test('with a context it plays what the ball does, and the context stays the game\'s', async () => {
    const one = game(), context = new Context(), felt = await feel(one.engine, { ...field, physvib, layout: 'ring3', context });
    await until(() => felt.output || felt.error);
    assert.equal(felt.error, null);
    assert.deepEqual([felt.output.channels, context.state], [3, 'running']);
    felt.set(one.ball, { isSource: true, material: 'wooden board', gain: 0.5 });
    assert.ok(heard(one, context) > 1);
    assert.doesNotMatch(felt.explain(), /Nothing plays/);
    felt.close();
    context.run(1);
    assert.deepEqual([context.isAlive, context.isClosed], [false, false]);
});

test('what is felt is heard, in the same frame, left and right by its place', async () => {
    const onsetOf = channel => channel.findIndex(value => Math.abs(value) > 1e-7);
    for (const [sound, ears] of [[true, [5, 6]], [{ outputs: [8, 7], level: 0.2 }, [8, 7]]]) {
        const one = game(), context = new Context(), felt = await feel(one.engine, { ...field, physvib, context, outputs: [1, 2, 3, 4], sound });
        await until(() => felt.output || felt.error);
        assert.equal(felt.error, null);
        felt.set(one.ball, 'wooden board');
        heard(one, context);
        const [left, right, ...hands] = [...ears, 1, 2, 3, 4].map(output => context.heard[output - 1]), onset = Math.min(...hands.map(onsetOf).filter(frame => frame >= 0));
        console.log(`the ear ${onsetOf(left) - onset} frames behind the hand`);
        assert.equal(onsetOf(left), onset);
        const power = channel => channel.reduce((sum, value) => sum + value * value, 0);
        assert.ok(Math.abs(Math.sqrt(power(right) / power(left)) - Math.sqrt(0.25 / 0.75)) < 0.02, 'at a quarter of the field, by the law of energy');
        felt.close();
    }
    const context = new Context(), felt = await feel(game().engine, { ...field, physvib, context, layout: 'pico8', sound: true });
    await until(() => felt.output);
    assert.equal(felt.sound, null, 'no output is left');
    felt.close();
    const { error } = console, other = new Context();
    console.error = () => {};
    const hands = await feel(game().engine, { ...field, physvib, context: other, outputs: [1, 2, 3, 4], sound: { outputs: [8, 9] } });
    await until(() => hands.output);
    console.error = error;
    assert.match(hands.error?.message ?? '', /outputs: expected 2 different numbers, 1 to 8/);
    assert.ok(hands.output && hands.sound === null, 'and the hands are felt');
    hands.close();
});

test('a page plays from the first gesture on, once, and until it is closed', () => onPage({ userActivation: { hasBeenActive: false } }, async gesture => {
    const one = game(), felt = await feel(one.engine, { ...field, physvib });
    felt.set(one.ball, 'wooden board');
    assert.equal(Context.made.length, 0);
    gesture('keydown');
    gesture('pointerdown');
    await until(() => felt.output);
    const [context, ...more] = Context.made;
    assert.deepEqual([more.length, context.state], [0, 'running']);
    assert.ok(heard(one, context) > 1);
    felt.close();
    assert.ok(context.isClosed);
    const early = await feel(game().engine, { ...field, physvib });
    early.close();
    gesture('pointerdown');
    assert.equal(Context.made.length, 1, 'one that is closed does not begin');
    const hasty = await feel(game().engine, { ...field, physvib });
    gesture('touchend');
    hasty.close();
    await until(() => Context.made[1].physvib);
    await new Promise(done => setTimeout(done, 5));
    Context.made[1].run(1);
    assert.deepEqual([hasty.output, Context.made[1].isAlive], [null, false], 'what opens when it is closed is closed');
    navigator.userActivation.hasBeenActive = true;
    const late = await feel(game().engine, { ...field, physvib });
    await until(() => late.output);
    assert.equal(Context.made.length, 3);
    late.close();
}));

test('without sound the game goes on, and says why', () => onPage({}, async (gesture, lines) => {
    const { engine, ball, step } = game(), felt = await feel(engine, { ...field, physvib });
    felt.set(ball, 'wooden board');
    gesture('keydown');
    await until(() => felt.error);
    for (let i = 0; i < 240; ++i) step();
    assert.ok(felt.haptics.take(true).length > 0);
    assert.match(felt.explain(), /^No device\. /);
    assert.deepEqual(lines, ['PhysVib: no sound, the game goes on: No device.']);
    felt.close();
}, class { constructor() { throw new Error('No device.'); } }));

test('controllers get it, too', () => {
    const sent = [], pad = { connected: true, vibrationActuator: { effects: ['dual-rumble'], playEffect(_, { strongMagnitude }) { sent.push(strongMagnitude); return Promise.resolve('complete'); }, reset() { sent.push(-1); return Promise.resolve('complete'); } } };
    return onPage({ getGamepads: () => [null, pad] }, async () => {
        const { engine, ball, step } = game(), felt = await feel(engine, { ...field, physvib });
        felt.set(ball, 'wooden board');
        for (let i = 0; i < 240; ++i) step();
        await until(() => sent.some(strong => strong > 0));
        assert.ok(sent.some(strong => strong > 0), 'a motor runs');
        felt.close();
        assert.equal(sent.at(-1), -1, 'and stands still');
        const other = game();
        await assert.rejects(feel(other.engine, { ...field, physvib, profile: 'pad-none' }), /pad-generic/);
        assert.deepEqual(Object.values(other.engine.events).flat(), [], 'what is refused leaves nothing');
    });
});

test('its types are real, in node10 too', () => {
    const work = mkdtempSync(join(tmpdir(), 'physvib-types-'));
    symlinkSync(join(folder, 'node_modules'), join(work, 'node_modules'));
    writeFileSync(join(work, 'game.ts'), `import { feel } from 'physvib/feel';\nimport { attach } from 'physvib/planck';\nasync function run(engine: { world: object; pairs: object; timing: object }) {
    const felt = await feel(engine, { pixelsPerMetre: 100, layout: 'phone4' });
    felt.set({}, 'wooden board');\n    const wrong: number = felt.explain(); // @ts-expect-error\n    attach(felt.physvib, engine).update(1 / 60);\n}\nvoid run;\n`.replace('    const wrong: number = felt.explain(); // @ts-expect-error', '    // @ts-expect-error\n    const wrong: number = felt.explain();'));
    for (const way of ['node10', 'bundler']) execFileSync(process.execPath, [at.resolve('typescript/bin/tsc'), '--noEmit', '--strict', '--target', 'es2022', '--module', 'es2022', '--moduleResolution', way, join(work, 'game.ts')], { stdio: 'inherit' });
});
