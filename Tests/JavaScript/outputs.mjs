// SPDX-License-Identifier: MIT
// What device outputs get from the package and the page in Chromium and Firefox: outputs.sh starts it, with a sound server. Prints what each found; 1 if something is not as it must be.
// usage: outputs.mjs PACKAGE PAGE [BROWSER...]
import { execFileSync, spawn } from 'node:child_process';
import { join } from 'node:path';
import { inBrowsers, receive, send, serve } from './browser/browsers.mjs';

const [folder, page, ...wanted] = process.argv.slice(2), browsers = wanted.length > 0 ? wanted : ['Chromium', 'Firefox'];
const { PULSE_PROGRAMS: programs, PULSE_LIBRARIES: libraries } = process.env, env = { ...process.env, LD_LIBRARY_PATH: libraries };
const outputs = 8, places = 'front-left,front-right,rear-left,rear-right,front-center,lfe,side-left,side-right'; // as ALSA numbers the outputs of a card
const pactl = (...words) => execFileSync(join(programs, 'pactl'), words, { env, encoding: 'utf8' });
let heard = [], recorder = null;
function peaksOf(bytes) {
    const peaks = new Array(outputs).fill(0);
    for (let i = 0; i < bytes.length >> 2; ++i) peaks[i % outputs] = Math.max(peaks[i % outputs], Math.abs(bytes.readFloatLE(4 * i)));
    return peaks;
}
const acts = {
    plug() {
        acts.unplug();
        pactl('load-module', 'module-null-sink', 'sink_name=card', `channels=${outputs}`, 'rate=48000', 'format=float32le', `channel_map=${places}`);
        recorder = spawn(join(programs, 'parec'), ['-d', 'card.monitor', '--format=float32le', `--channels=${outputs}`, '--rate=48000', `--channel-map=${places}`, '--latency-msec=20', '--raw'], { env });
        recorder.stdout.on('data', part => heard.push(part));
    },
    unplug() {
        recorder?.kill();
        for (const [, number] of pactl('list', 'short', 'modules').matchAll(/^(\d+)\tmodule-null-sink/gm)) pactl('unload-module', number);
    },
    hear() { heard = []; },
    /** The peak of each device output since `hear`. */
    heard: () => peaksOf(Buffer.concat(heard)),
    /** The same in turn: a row for each run of 50 ms in which one output is the loudest. */
    inTurn() {
        const bytes = Buffer.concat(heard), rows = [], block = 4 * outputs * 2400;
        for (let from = 0, last = -1; from < bytes.length; from += block) {
            const peaks = peaksOf(bytes.subarray(from, from + block)), loudest = peaks.indexOf(Math.max(...peaks));
            if (peaks[loudest] < 0.02) continue;
            rows.push(loudest === last ? rows.pop().map((peak, i) => Math.max(peak, peaks[i])) : peaks);
            last = loudest;
        }
        return rows;
    },
};

const imports = { physvib: '/physvib/physvib.js', 'physvib/audio': '/physvib/audio.js' };
const head = `<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><script type="importmap">${JSON.stringify({ imports })}</script>`;
const made = ({ of, frame }) => `${head}<body><script type="module">
import { ask, run } from '/browser/outputs.mjs';
${frame ? `const told = await new Promise(done => { onmessage = ({ data }) => done(data); const frame = document.createElement('iframe'); frame.allow = 'autoplay'; frame.width = 1000; frame.height = 700; frame.src = '/page/index.html?${of}'; document.body.append(frame); });`
        : `const told = await run('${of}');`}
await fetch('/', { method: 'POST', body: JSON.stringify(told) });
</script></body>`;
let arrived = () => {};
const { server, origin } = await serve((request, response, path) => {
    const name = path.slice(1), [, kind, of] = name.match(/^(package|page)-(\w+)$/) ?? [];
    if (request.method === 'POST' && acts[name]) {
        const answer = acts[name]();
        receive(request, { end: () => response.end(JSON.stringify(answer ?? null)) }, () => {});
    } else if (request.method === 'POST') receive(request, response, told => arrived(told));
    else if (kind) {
        response.writeHead(200, { 'Content-Type': 'text/html' });
        response.end(made({ of, frame: kind === 'page' }));
    } else if (path.startsWith('/physvib/')) send(response, join(folder, path.slice(9)));
    else if (path.startsWith('/browser/')) send(response, join(import.meta.dirname, path));
    else if (/^\/page\/(index\.html)?$/.test(path)) send(response, join(page, 'index.html'), {}, text => text.replace('</head>', '<script type="module" src="/browser/outputs.mjs"></script></head>'));
    else if (path.startsWith('/page/')) send(response, join(page, path.slice(6)));
    else send(response, 'nothing');
});

const failures = [], expect = (holds, what) => { console.log(`${holds ? 'ok    ' : 'FAILED'} ${what}`); if (!holds) failures.push(what); };
async function told(browser, of, seconds = 120, more = {}) {
    const { [browser]: found } = await inBrowsers([browser], `${origin}/${of}`, seconds, done => { arrived = done; }, more);
    expect(found.error === undefined && Object.keys(found).length > 0, `${browser}, ${of}: ${found.error ?? (Object.keys(found).length > 0 ? 'it ran' : 'nothing was told')}`);
    return found;
}
const words = peaks => peaks.map(peak => peak.toFixed(2)).join(' ');
/** Actuator j at that output, and at no other. */
const isAt = (peaks, output) => peaks.every((peak, i) => (i === output ? peak > 0.05 : peak < 0.001));

for (const browser of browsers) {
    acts.plug();
    const { rows = [] } = await told(browser, 'package-outputs', 600);
    for (const { count, wish, facts = {}, peaks, error } of rows) {
        const order = wish ?? peaks.map((_, j) => j + 1), isRight = !error && peaks.every((found, j) => isAt(found, order[j] - 1));
        expect(isRight, `${browser}: ${count} actuators${wish ? `, outputs ${wish}` : ''} of ${facts.max} outputs, isDirect ${facts.isDirect}${isRight ? `: each at its own, ${order}` : `: ${error ?? JSON.stringify(facts)}\n${peaks.map(found => `         ${words(found)}`).join('\n')}`}`);
    }
    const { buzzes = [] } = await told(browser, 'page-buzz');
    expect(buzzes.length === 5 && buzzes.every((found, j) => isAt(found, j)), `${browser}, the page's Buzz with five actuators: ${buzzes.map(words).join(' | ')}`);
    const { struck, moves, late, latest, pending } = await told(browser, 'package-worlds');
    expect(struck > 20 && pending === 0 && latest < 0.5, `${browser}: two worlds on one output: ${struck} hits, the latest is felt after ${latest} s, ${pending} wait, ${moves} moves, ${late} late`);
    const lost = await told(browser, 'package-lost');
    expect(['running', 'device lost', 'running'].every((state, i) => lost.states?.filter((one, j, all) => one !== all[j - 1])[i] === state), `${browser}: unplugged and plugged in: states ${lost.states}`);
    expect(lost.gone?.running === false && lost.gone?.frames === 0 && lost.back?.running && lost.back?.peak > 0.01, `${browser}: what left: gone ${JSON.stringify(lost.gone)}, back ${JSON.stringify(lost.back)}`);
    expect(/nothing has left the output/.test(lost.why) && !/amplifier/.test(lost.why), `${browser}: ${lost.why}`);
    expect(/left the output/.test(lost.backWhy) && /amplifier/.test(lost.backWhy), `${browser}: ${lost.backWhy}`);
    acts.plug();
    const pageLost = await told(browser, 'page-lost');
    expect(/no sound device/.test(pageLost.gone) && !/no sound device/.test(pageLost.back) && pageLost.moved && pageLost.heard > 0.001, `${browser}, the page: unplugged "${pageLost.gone}"; plugged in "${pageLost.back}", the world ${pageLost.moved ? 'moves' : 'stands'}, peak ${pageLost.heard}`);
    acts.unplug();
    const begun = await told(browser, 'page-later');
    expect(begun.movedBefore && /no sound device/.test(begun.before) && begun.began && begun.moved && begun.heard > 0.001, `${browser}, the page, started before its device was there: "${begun.before}", then "${begun.line}", peak ${begun.heard}`);
    acts.unplug();
    const none = await told(browser, 'page-none', 120, { PULSE_SERVER: 'unix:/nowhere' });
    expect(none.moved && /no sound device/.test(none.line) && none.canStart !== false, `${browser}, the page without a device: "${none.line}", the world ${none.moved ? 'moves' : 'stands'}`);
}
acts.unplug();
server.close();
console.log(failures.length > 0 ? `${failures.length} failed` : 'every actuator at its output');
process.exit(failures.length > 0 ? 1 : 0);
