// SPDX-License-Identifier: MIT
// How late impacts are felt in a page whose game makes so many pictures a second: what the audio thread plays, heard by another worklet.
import { load } from 'physvib';
import { play } from 'physvib/audio';

const listener = `registerProcessor('listener', class extends AudioWorkletProcessor {
    quiet = 0;
    process([[channel]]) {
        channel?.forEach((sample, i) => {
            if (Math.abs(sample) < 1e-4) { ++this.quiet; return; }
            if (this.quiet > 0.05 * sampleRate) this.port.postMessage(currentFrame + i);
            this.quiet = 0;
        });
        return true;
    }
})`;
// The smallest page that could: each message is the next quantum's click. A hit may have happened a picture before, so one latency for all is at least a picture more than its longest.
const smallest = `registerProcessor('smallest', class extends AudioWorkletProcessor {
    constructor() { super(); this.port.onmessage = () => { this.isHit = true; }; }
    process(_, [[out]]) { if (this.isHit) out[0] = 1; this.isHit = false; return true; }
})`;
const settled = 1.5, between = 0.2, stutter = 0.03; // s: the game's first second says what latency it wants

async function smallestOf(context) {
    await context.audioWorklet.addModule(URL.createObjectURL(new Blob([smallest], { type: 'text/javascript' })));
    const node = new AudioWorkletNode(context, 'smallest');
    return { node, latencyFrames: 0, latency: 0, moves: 0, status: { late: 0 }, close: () => {}, follow: ({ follow }) => follow(events => { if (events.length > 0) node.port.postMessage(0); }) };
}

/** What a game tells of `seconds` at so many pictures; or the smallest page. */
export async function rateOf(pictures, seconds, isSmallest = false) {
    const physvib = await load(), context = new AudioContext(), heard = [], struck = [];
    await Promise.race([context.resume(), new Promise(done => setTimeout(done, 10000))]); // Firefox opens its sound for seconds
    if (context.state !== 'running') return { error: `the AudioContext is ${context.state}` };
    await context.audioWorklet.addModule(URL.createObjectURL(new Blob([listener], { type: 'text/javascript' })));
    const output = isSmallest ? await smallestOf(context) : await play(physvib, context, { layout: 'phone1', fieldWidth: 1, fieldHeight: 1 }), ear = new AudioWorkletNode(context, 'listener');
    ear.port.onmessage = ({ data }) => heard.push(data / context.sampleRate - output.latencyFrames / context.sampleRate);
    output.node.connect(ear).connect(new GainNode(context, { gain: 0 })).connect(context.destination);
    const world = physvib.world(), followers = new Set();
    world.setBody(0);
    world.setBody(1, { massKg: 1, isSource: true, frequencyHz: 400, decayPerSecond: 300 });
    output.follow({ follow: follower => { followers.add(follower); return () => {}; } });
    await new Promise(done => setTimeout(done, 300));
    const began = performance.now();
    let last = began, due = settled, lateBefore = null, movesBefore = 0, stutters = 0, aheadBefore = context.currentTime;
    for (let picture = 1; last - began < 1000 * seconds; ++picture) {
        await new Promise(done => setTimeout(done, Math.max(0, began + 1000 * picture / pictures - performance.now())));
        const now = performance.now(), passed = Math.min(0.1, (now - last) / 1000), at = (now - began) / 1000, isHit = at >= due && at < seconds - 0.3, ahead = context.currentTime - at;
        if (at > settled - between && lateBefore === null) [lateBefore, movesBefore] = [output.status.late, output.moves];
        last = now;
        if (isHit) { due = at + between; struck.push(context.currentTime); }
        if (at > settled - between && (passed > 1 / pictures + stutter || Math.abs(ahead - aheadBefore) > stutter)) ++stutters; // of pictures or of sound, on a busy machine
        aheadBefore = ahead;
        world.step(passed, 9.81, () => { if (isHit) world.touch(1, 0, { x: 0.5, y: 0.5, normalX: 0, normalY: -1, approach: 3, fraction: 1 }); });
        const events = world.take(true);
        for (const follower of followers) follower(events, world);
    }
    await new Promise(done => setTimeout(done, 800));
    const latencies = struck.map(time => heard.find(onset => onset >= time - 1e-9)).map((onset, i) => 1000 * (onset - struck[i])).filter(ms => ms < 1000 * between).sort((a, b) => a - b), told = {
        struck: struck.length, heard: latencies.length, late: output.status.late - lateBefore, moves: output.moves - movesBefore, stutters, asked: 1000 * output.latency, median: latencies[latencies.length >> 1], least: latencies[0], most: latencies.at(-1),
    };
    output.close();
    await context.close();
    return told;
}
