// SPDX-License-Identifier: MIT
// What a fixture of each bundler runs in a page: the code, both modules of WebAssembly, the audio thread, and a worker. bundlers.mjs puts the two imports before it.
import { attach } from 'physvib/matter';
import { play } from 'physvib/audio';

const events = [{ timeNs: 1e6, frequencyHz: 200, decayPerSecond: 30, amplitude: 0.5, x: 0.01, y: 0.02, fixture: 1, other: 0 }], seconds = 0.2, rate = 48000;
const sumOf = channels => channels.reduce((sum, channel) => channel.reduce((hash, sample) => (hash * 31 + Math.round(sample * 1e9)) | 0, sum), 0);

async function inWorklet(physvib, late) {
    const context = new OfflineAudioContext(4, rate * seconds, rate), output = await play(physvib, context, { layout: 'phone4', level: 1, ...late });
    output.strike(events, 0);
    await output.arrived();
    const recorded = await context.startRendering();
    return Array.from({ length: 4 }, (_, j) => recorded.getChannelData(j).slice(output.latencyFrames));
}

async function run(physvib, startWorker) {
    const told = { version: physvib.version, attaches: typeof attach };
    const wanted = physvib.render(events, { seconds, layout: 'phone4' });
    told.sum = sumOf(wanted);
    told.events = (await physvib.parseEvents(await physvib.eventsText(events))).length;
    const got = await inWorklet(physvib, globalThis.workletAddress ? { worklet: globalThis.workletAddress } : {}); // of a page that may make no blobs
    told.worklet = got.every((channel, j) => channel.every((sample, n) => sample === wanted[j][n])) ? 'same' : got.every(channel => channel.every(sample => sample === 0)) ? 'silent' : 'other';
    const worker = startWorker(), answer = new Promise((done, failed) => { worker.onmessage = ({ data }) => done(data); worker.onerror = event => failed(new Error(`worker: ${event.message}`)); });
    worker.postMessage(events);
    told.worker = (await answer) === told.sum ? 'same' : await answer;
    worker.terminate();
    return told;
}

const tell = told => parent.postMessage(told, '*');
addEventListener('unhandledrejection', ({ reason }) => tell({ error: String(reason?.message ?? reason) }));
