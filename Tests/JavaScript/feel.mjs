// SPDX-License-Identifier: MIT
// All of it by one call, in each engine: feel.mjs FOLDER. In Node nothing plays; a stub of a page's context does.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, symlinkSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join, resolve } from 'node:path';
import test from 'node:test';
import { Context as Fake } from './fake-audio.mjs';
import { load } from './installed.mjs';

const folder = resolve(process.argv[2]), { feel } = await load(folder, 'physvib/feel'), at = createRequire(join(folder, 'index.js'));
const { default: Matter } = await load(folder, 'matter-js');
function game() {
    const engine = Matter.Engine.create(), ball = Matter.Bodies.circle(200, 300, 20);
    Matter.Composite.add(engine.world, [Matter.Bodies.rectangle(400, 590, 800, 20, { isStatic: true }), ball]);
    return { engine, ball, step: () => Matter.Engine.update(engine, 1000 / 240) };
}

test('Matter: a ball of a material is felt, and close() ends it', async () => {
    const { engine, ball, step } = game(), felt = await feel(engine, { pixelsPerMetre: 100, fieldWidth: 8, fieldHeight: 6 });
    felt.set(ball, 'wooden board');
    for (let i = 0; i < 240; ++i) step();
    const events = felt.haptics.take(true), { material } = await load(folder, 'physvib');
    assert.ok(events.length > 0 && events.every(({ frequencyHz }) => frequencyHz === material('wooden board').frequencyHz), felt.explain());
    assert.ok(Math.abs(events[0].x - 2) < 0.01 && Math.abs(events[0].y - 0.2) < 0.02, 'metres of the field');
    assert.equal(felt.output, null);
    assert.match(felt.explain(), /^Nothing plays before the first click or key\./);
    assert.throws(() => felt.set(ball, 'cheese'), /material: expected one that vibrates/);
    felt.close();
    felt.close();
    step();
});

test('other engines are known, and what is none is refused', async () => {
    const planck = await load(folder, 'planck').then(module => module.default ?? module), worlds = [new planck.World(), { bodies: () => [], read() {} }];
    for (const kind of ['2d', '3d']) {
        const { default: R } = await load(folder, `@dimforge/rapier${kind}-compat`);
        await R.init();
        worlds.push(new R.World({ x: 0, y: -9.81, z: 0 }));
    }
    for (const world of worlds) (await feel(world)).close();
    await assert.rejects(feel({}), /feel: expected an engine's world/);
    await assert.rejects(feel(worlds[0], { feildWidth: 1 }), /feildWidth/);
});

test('with a context it plays', async () => {
    const { engine, ball, step } = game(), context = new Fake(readFileSync(at.resolve('physvib/worklet.js'), 'utf8'), 8);
    context.resume ??= async () => {};
    const felt = await feel(engine, { pixelsPerMetre: 100, fieldWidth: 8, fieldHeight: 6, layout: 'phone4', context });
    for (let i = 0; i < 100 && !felt.output && !felt.error; ++i) await new Promise(done => setTimeout(done, 10));
    assert.equal(felt.error, null);
    assert.equal(felt.output.channels, 4);
    felt.set(ball, { isSource: true, material: 'wooden board', gain: 0.5 });
    step();
    felt.close();
});

test('its types are real, in node10 too', () => {
    const work = mkdtempSync(join(tmpdir(), 'physvib-types-'));
    symlinkSync(join(folder, 'node_modules'), join(work, 'node_modules'));
    writeFileSync(join(work, 'game.ts'), `import { feel } from 'physvib/feel';\nimport { attach } from 'physvib/planck';\nasync function run(engine: { world: object; pairs: object; timing: object }) {
    const felt = await feel(engine, { pixelsPerMetre: 100, layout: 'phone4' });
    felt.set({}, 'wooden board');\n    const wrong: number = felt.explain(); // @ts-expect-error\n    attach(felt.physvib, engine).update(1 / 60);\n}\nvoid run;\n`.replace('    const wrong: number = felt.explain(); // @ts-expect-error', '    // @ts-expect-error\n    const wrong: number = felt.explain();'));
    for (const way of ['node10', 'bundler']) execFileSync(process.execPath, [at.resolve('typescript/bin/tsc'), '--noEmit', '--strict', '--target', 'es2022', '--module', 'es2022', '--moduleResolution', way, join(work, 'game.ts')], { stdio: 'inherit' });
});
