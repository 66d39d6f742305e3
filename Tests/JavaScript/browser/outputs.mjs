// SPDX-License-Identifier: MIT
// Within a browser: what outputs.mjs asks. In the page (its iframe) the name stands behind the question mark, and the answer goes to the parent.
const later = ms => new Promise(done => setTimeout(done, ms));
/** An act of outputs.mjs, by its name. */
export const ask = what => fetch(`/${what}`, { method: 'POST', body: '0' }).then(answer => answer.json());
/** Until that holds, for so many ms at most: whether it did. */
async function until(holds, ms = 15000) {
    for (const began = performance.now(); performance.now() - began < ms; await later(50)) if (await holds()) return true;
    return false;
}
/** Until the device has heard something, on a machine with other work as well, and the third of a second after it. */
const sounded = async () => { await until(async () => (await ask('heard')).some(peak => peak > 0.02), 10000); await later(300); };
const row = count => ({ extentWidth: count, extentHeight: 1, places: Array.from({ length: count }, (_, j) => ({ x: j + 0.5, y: 0.5 })) });
async function opened(options = {}) {
    const [{ load }, { play }] = await Promise.all([import('physvib'), import('physvib/audio')]), context = new AudioContext();
    await Promise.race([context.resume(), later(15000)]);
    const physvib = await load(), output = await play(physvib, context, { layout: row(4), fieldWidth: 4, fieldHeight: 1, law: 'neighbours', ...options });
    return { physvib, context, output };
}

const parts = {
    async outputs() {
        const rows = [];
        for (const [count, wish] of [1, 2, 3, 4, 5, 6, 7, 8].map(count => [count]).concat([[3, [8, 5, 2]]])) {
            const { context, output, error } = await opened({ layout: row(count), fieldWidth: count, ...(wish && { outputs: wish }) }).catch(error => ({ error })), peaks = [];
            if (error) { rows.push({ count, wish, peaks, error: error.message }); continue; }
            await later(2500);
            for (let j = 0; j < count; ++j) {
                await ask('hear');
                output.impact({ x: j + 0.5, y: 0.5, strength: 0.8 });
                await sounded();
                peaks.push(await ask('heard'));
            }
            rows.push({ count, wish, peaks, facts: { isDirect: output.isDirect, max: context.destination.maxChannelCount, state: output.state, skipped: output.skipped, ...output.status } });
            output.close();
            await context.close();
        }
        return { rows };
    },

    // Two worlds of other ages, 60 steps a second for 4 s; each hit is looked for in the worklet's samples.
    async worlds() {
        const { physvib, context, output } = await opened(), kept = { struck: 0, latest: 0 }, worlds = [];
        const make = () => {
            const world = physvib.world({ fieldWidth: 4, fieldHeight: 1 }), followers = new Set();
            world.setBody(0);
            world.setBody(1, { massKg: 1, isSource: true, frequencyHz: 400, decayPerSecond: 300 });
            output.follow({ follow: follower => { followers.add(follower); return () => followers.delete(follower); } });
            worlds.push({ world, followers });
        };
        const { strike } = output;
        output.strike = function (events, laterNs) { // as followers call it, with times of the context
            for (const { timeNs } of events) {
                ++kept.struck;
                kept.latest = Math.max(kept.latest, timeNs * 1e-9 - context.currentTime);
            }
            return strike.call(this, events, laterNs);
        };
        make();
        let step = 0;
        const run = async seconds => {
            for (const end = step + 60 * seconds, began = performance.now() - 1000 * step / 60; step < end; await later(Math.max(0, began + 1000 * step / 60 - performance.now()))) {
                ++step;
                for (const { world, followers } of worlds) {
                    world.step(1 / 60, 9.81, () => { if (step % 12 === 0) world.touch(1, 0, { x: 2, y: 0.5, normalX: 0, normalY: -1, approach: 3 }); });
                    const events = world.take();
                    for (const follower of followers) follower(events, world);
                }
            }
        };
        await run(3);
        const before = output.status.late;
        make();
        await run(4);
        await later(1000);
        return { ...kept, latest: +kept.latest.toFixed(3), moves: output.moves, late: output.status.late - before, pending: output.status.pending };
    },

    async lost() {
        const { physvib, context, output } = await opened(), states = [], world = physvib.world({ fieldWidth: 4, fieldHeight: 1 }), hit = () => {
            world.step(0.01, 9.81);
            world.step(0.01, 9.81, () => world.touch(1, 0, { x: 2, y: 0.5, normalX: 0, normalY: -1, approach: 3 }));
            output.impact({ x: 2, y: 0.5, strength: 0.8 });
        };
        world.setBody(0);
        world.setBody(1, { massKg: 1, isSource: true, frequencyHz: 200, decayPerSecond: 30 });
        output.addEventListener?.('state', ({ state }) => states.push(state));
        states.push(output.state);
        hit();
        await later(1500);
        world.explain(output);
        await ask('unplug');
        await until(() => output.state === 'device lost', 6000);
        const from = context.currentTime;
        hit();
        await later(700);
        const gone = output.left?.(from, context.currentTime)[1], why = world.explain(output);
        await later(1500);
        await ask('plug');
        await until(() => output.state === 'running', 10000);
        await later(2500);
        const again = context.currentTime;
        hit();
        await until(() => output.left?.(again, context.currentTime)[1].peak > 0, 10000);
        const heard = context.currentTime;
        await later(300);
        return { states, gone, why, back: output.left?.(again, heard)[1], backWhy: world.explain(output) };
    },

    // ---- in the page
    async buzz() {
        const { $ } = await started(), transfer = new DataTransfer();
        transfer.items.add(new File(['time_s,frequency_hz,decay_per_s,amplitude,x_m,y_m\n1000,100,30,0.5,0.1,0.1\n'], 'still.csv')); // buzzes are all that is heard
        document.dispatchEvent(new DragEvent('drop', { dataTransfer: transfer, bubbles: true, cancelable: true }));
        await until(() => document.title.startsWith('still'));
        $('attach').click();
        await later(2500);
        await ask('hear');
        $('buzz').click();
        await until(() => !$('buzz').disabled, 30000);
        await later(3000); // a busy machine's sound is late
        return { buzzes: await ask('inTurn') };
    },
    async lostPage() {
        const { $, isMoving } = await started(), line = () => $('output').textContent;
        await later(1000);
        await ask('unplug');
        await until(() => /no sound device/.test(line()), 6000);
        const gone = line();
        await later(1500);
        await ask('plug');
        await until(() => !/no sound device/.test(line()), 6000);
        $('again').click();
        await later(1500);
        await ask('hear');
        const moved = await until(isMoving, 3000);
        await later(3000);
        return { gone, back: line(), moved, heard: Math.max(...await ask('heard')) };
    },
    /** Start where there is no device yet. */
    async later() {
        const { $, isMoving } = await started(3000), movedBefore = await until(isMoving, 3000);
        await until(() => /no sound device/.test($('output').textContent), 6000);
        const before = $('output').textContent;
        await ask('plug');
        const began = await until(() => $('begin').hidden && !/no sound device/.test($('output').textContent), 15000);
        await later(1500);
        await ask('hear');
        const moved = await until(isMoving, 3000);
        $('again').click();
        await later(4000);
        return { before, movedBefore, began, moved, line: $('output').textContent, heard: Math.max(...await ask('heard')) };
    },
    async none() {
        const { $, isMoving } = await started(8000);
        const moved = await until(isMoving, 3000);
        await until(() => /no sound device/.test($('output').textContent), 3000);
        return { moved, line: $('output').textContent, canStart: $('begin').hidden || !$('start').disabled };
    },
};
export const run = async name => { try { return await parts[name](); } catch (error) { return { error: String(error?.stack ?? error) }; } };

async function started(ms = 15000) {
    const $ = id => document.getElementById(id), { world } = await import('/page/page.js');
    if (!await until(() => $('start')?.disabled === false)) throw new Error('no page that can start');
    $('start').click();
    await until(() => $('begin').hidden, ms);
    const isMoving = async () => {
        const before = [...world.poses];
        await later(300);
        return world.poses.some((value, i) => Math.abs(value - before[i]) > 1e-4);
    };
    return { $, world, isMoving };
}
if (location.pathname.startsWith('/page/')) run({ '?lost': 'lostPage' }[location.search] ?? location.search.slice(1)).then(told => parent.postMessage(told, '*'));
