// SPDX-License-Identifier: MIT
// Native Box2D in the worlds of worlds.mjs. Where there are programs, its traces are made, and kept for a browser.
const kinds = ['hit', 'roll', 'slide'];

/** Events, and motions of body 1 and of the last one. */
function readTrace(text, last) {
    const events = [], motions = [], lasts = [];
    for (const line of text.split('\n')) {
        const [word, ...numbers] = line.split(' '), values = numbers.map(Number);
        if (word === 'e') {
            const [seconds, fixture, other, impulse, , , kind] = values;
            events.push({ seconds, fixture, other, impulse, kind: kinds[kind] });
        } else if (word === 'm') {
            const [, id, x, y, vx, vy, spin] = values, motion = { x, y, vx, vy, spin };
            if (id === 1) motions.push(motion);
            if (id === last) lasts.push(motion);
        }
    }
    return { events, motions, lasts };
}

/** Of each "WORLD/RATE" its trace; none where there is no program. */
export async function nativeTraces(folder, program, worlds, rates) {
    if (globalThis.document) return (await fetch('/native.json')).json();
    if (!program) return {};
    const { execFileSync } = await import('node:child_process'), { writeFileSync } = await import('node:fs');
    const { join, resolve } = await import('node:path'), { textOf } = await import('./trace.mjs'), traces = {};
    const path = join(resolve(folder), 'world.txt');
    for (const [kind, world] of Object.entries(worlds)) for (const hz of rates) {
        writeFileSync(path, textOf(world, hz));
        const text = execFileSync(resolve(program), [path], { encoding: 'utf8', maxBuffer: 1 << 28 });
        traces[`${kind}/${hz}`] = readTrace(text, world.bodies.at(-1).id);
    }
    writeFileSync(join(resolve(folder), 'native.json'), JSON.stringify(traces));
    return traces;
}
