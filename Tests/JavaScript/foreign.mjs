// SPDX-License-Identifier: MIT
// Examples that others wrote: their motion, to the bit, with and without haptics. Prints a table; 1 if a motion differs, or haptics end. What does not run without
// a page, or differs from itself, is named.
// usage: foreign.mjs FOLDER ENGINE=EXAMPLES... FOLDER: where npm has installed physvib, the engines and esbuild. EXAMPLES: of matter, matter-js's examples; of planck,
// planck.js's example; of rapier2d and rapier3d, demos of rapier.js's testbeds (testbed2d/src/demos). foreign.mjs FOLDER --one ENGINE FILE IS_FELT is for itself.
import { execFile } from 'node:child_process';
import { createHash } from 'node:crypto';
import { mkdtempSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { basename, join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { load } from './installed.mjs';

const [folder, ...words] = process.argv.slice(2), steps = 300, seconds = 1 / 60, source = { isSource: true, frequencyHz: 200, decayPerSecond: 30 };
const require = createRequire(join(resolve(folder), 'index.js'));

/** Anything of a page: an object whose members may be called, set and read. */
const anything = (known = {}) => new Proxy(function () {}, {
    get: (target, name) => (name in known ? known[name] : name === Symbol.toPrimitive ? () => 0 : name === Symbol.iterator ? undefined : known[name] = anything()),
    set: (target, name, value) => { known[name] = value; return true; }, apply: () => anything(), construct: () => anything(), has: (target, name) => name in known,
});
/** JavaScript of a file in TypeScript, as a module. */
async function moduleOf(file, options) {
    const to = join(mkdtempSync(join(tmpdir(), 'physvib-foreign-')), 'example.mjs');
    await require('esbuild').build({ entryPoints: [file], outfile: to, format: 'esm', platform: 'node', logLevel: 'silent', ...options });
    return import(pathToFileURL(to));
}

// Each gives the engine's world, and how it steps and moves.
const engines = {
    async matter(file) {
        const Matter = globalThis.Matter = require('matter-js'), { Composite, Engine, Render, Runner } = Matter, { attach } = await load(folder, 'physvib/matter');
        globalThis.window = globalThis;
        globalThis.document = anything();
        const place = () => ({ min: { x: 0, y: 0 }, max: { x: 800, y: 600 } });
        for (const name of Object.keys(Render)) if (typeof Render[name] === 'function') Render[name] = () => {};
        Render.create = ({ options } = {}) => ({ canvas: { ...anything, width: 800, height: 600, addEventListener() {}, getAttribute: () => null }, options: { width: 800, height: 600, ...options }, bounds: place(), textures: {}, context: anything() });
        Object.assign(Runner, { run() {}, start() {} });
        const { engine } = createRequire(file)(file)();
        const bodies = () => Composite.allBodies(engine.world);
        return { attach: physvib => attach(physvib, engine, { fieldWidth: 8, fieldHeight: 6 }), step: () => Engine.update(engine, 1000 * seconds), bodies,
            moves: body => !body.isStatic, read: ({ position, velocity, angle }) => [position.x, position.y, velocity.x, velocity.y, angle] };
    },
    async planck(file) {
        const { attach } = await load(folder, 'physvib/planck'), shim = join(mkdtempSync(join(tmpdir(), 'physvib-planck-')), 'planck.mjs'), start = {};
        globalThis.testbed = anything({ start: world => { start.world = world; }, step: undefined, activeKeys: {}, x: 0, y: 0, width: 80, height: 60, hz: 60, speed: 1, mouseForce: 0 });
        writeFileSync(shim, `export * from ${JSON.stringify(require.resolve('planck').replace(/\.js$/, '.mjs'))};\nexport const Testbed = { mount: () => globalThis.testbed };\n`);
        await moduleOf(file, { bundle: true, alias: { planck: shim } });
        const { world } = start, bodies = function* () { for (let body = world.getBodyList(); body; body = body.getNext()) yield body; };
        return { attach: physvib => attach(physvib, world, { fieldWidth: 40, fieldHeight: 40, fieldX: -20 }), bodies, moves: body => body.isDynamic(), step() { world.step(seconds); globalThis.testbed.step?.(1000 * seconds, 0); },
            read: body => [body.getPosition().x, body.getPosition().y, body.getLinearVelocity().x, body.getLinearVelocity().y, body.getAngle(), body.getAngularVelocity()] };
    },
    rapier2d: file => rapier('2d', file),
    rapier3d: file => rapier('3d', file),
};
async function rapier(kind, file) {
    const { default: R } = await load(folder, `@dimforge/rapier${kind}-compat`), { attach } = await load(folder, `physvib/rapier${kind}`), bed = {};
    await R.init();
    const { initWorld } = await moduleOf(file, {});
    initWorld(R, anything({ setWorld: world => { bed.world = world; }, setpreTimestepAction: action => { bed.action = action; }, parameters: { lookAt: undefined } }));
    const { world } = bed, before = () => bed.action?.(anything()), bodies = () => world.bodies.getAll();
    world.timestep = seconds;
    return { attach: physvib => attach(physvib, world, { fieldWidth: 40, fieldHeight: 40, fieldX: -20 }), bodies, moves: body => body.isDynamic(), step() { before(); world.step(); }, stepFelt(haptics) { before(); haptics.update(seconds); },
        read: body => [body.translation(), body.rotation(), body.linvel(), body.angvel()].flatMap(value => (typeof value === 'number' ? value : Object.values(value))) };
}

/** What one example does: a hash of its motion, and events. */
async function one(name, file, isFelt) {
    let state = 1;
    Math.random = () => (state = (Math.imul(state, 1664525) + 1013904223) >>> 0) / 2 ** 32;
    Date.now = performance.now = () => 1000 * seconds * told.steps;
    const told = { steps: 0, events: 0, bodies: 0 }, hash = createHash('sha256'), engine = await engines[name](file);
    const haptics = isFelt ? engine.attach(await (await load(folder, 'physvib')).load()) : null;
    for (; told.steps < steps; ++told.steps) {
        const all = [...engine.bodies()];
        if (told.steps === 0) told.bodies = all.length;
        if (haptics) for (const body of all) if (engine.moves(body)) haptics.set(body, source);
        if (haptics && engine.stepFelt) engine.stepFelt(haptics);
        else engine.step();
        told.events += haptics?.take().length ?? 0;
        for (const body of engine.bodies()) hash.update(new Float64Array(engine.read(body)));
    }
    return { ...told, hash: hash.digest('hex'), ended: haptics?.error?.message };
}

if (words[0] === '--one') {
    const [, name, file, isFelt] = words, say = told => { process.stdout.write(`\n${JSON.stringify(told)}\n`); process.exit(0); };
    console.log = console.info = console.warn = () => {};
    await one(name, resolve(file), isFelt === 'true').then(say, error => say({ error: String(error?.message ?? error).split('\n')[0] }));
}

const run = (name, file, isFelt) => new Promise(done => execFile(process.execPath, [process.argv[1], folder, '--one', name, file, String(isFelt)], { timeout: 600e3 },
    (error, text) => { try { done(JSON.parse(text.trim().split('\n').at(-1))); } catch { done({ error: error?.killed ? 'nothing within 600 s' : String(error?.message ?? text).split('\n')[0] }); } }));
const failures = [];
let same = 0, felt = 0;
console.log('| engine | example | bodies | motion with haptics | events in 5 s |\n| --- | --- | --- | --- | --- |');
const left = [];
for (const word of words) {
    const [name, place] = word.split('=');
    for (const entry of readdirSync(place).filter(each => /\.(js|ts)$/.test(each) && !/^index\./.test(each)).sort()) {
        const file = join(place, entry), title = basename(entry).replace(/\.\w+$/, ''), [without, again, felt1] = await Promise.all([run(name, file, false), run(name, file, false), run(name, file, true)]);
        if (without.error || without.hash !== again.hash || without.bodies < 1) { left.push(`${name} ${title}: ${without.error ?? (without.bodies < 1 ? 'no bodies' : 'differs from itself')}`); continue; }
        const isSame = felt1.hash === without.hash && !felt1.ended;
        if (isSame) ++same;
        else failures.push(`${name} ${title}: ${felt1.error ?? felt1.ended ?? 'another motion'}`);
        if (felt1.events > 0) ++felt;
        console.log(`| ${name} | ${title} | ${without.bodies} | ${isSame ? 'the same' : 'DIFFERENT'} | ${felt1.events ?? 0} |`);
    }
}
console.log(`\n${same} of ${same + failures.length} the same to the bit; ${felt} have impacts.`);
if (left.length > 0) console.log(`Left out, as they need a page or differ from themselves: ${left.join('; ')}.`);
for (const line of failures) console.log(`FAILED: ${line}`);
process.exit(failures.length > 0 || same === 0 ? 1 : 0);
