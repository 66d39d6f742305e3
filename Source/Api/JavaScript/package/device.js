// SPDX-License-Identifier: MIT
// Routing from an audio context to actuators: which outputs of the device they reach, and whether the device plays what it gets.
import { PhysVibError } from './module.js';

const patienceMs = 1000; // a browser may never answer where there is no device
const soon = promise => Promise.race([promise.then(() => true, () => false), new Promise(done => setTimeout(done, patienceMs, false))]);
const renewed = new WeakSet(); // contexts that get another device just now
const isReal = context => !('length' in context); // an OfflineAudioContext has no device
/** A context whose time stands still. */
export const stands = context => isReal(context) && ['suspended', 'interrupted', 'closed'].includes(context.state);

// The loudspeaker of each channel of a context of so many, and the order in which ALSA numbers the outputs of a card. With 1, 2 and 4 both are the same; other numbers are no loudspeakers.
const loudspeakers = { 5: 'FL FR FC RL RR', 6: 'FL FR FC LFE RL RR', 8: 'FL FR FC LFE RL RR SL SR' }, alsa = ['FL', 'FR', 'RL', 'RR', 'FC', 'LFE', 'SL', 'SR'];

/** The channel of a context that each output of a device of so many outputs is. */
export function channelsOfOutputs(count, { userAgent = '' } = globalThis.navigator ?? {}) {
    const places = /Linux|CrOS/.test(userAgent) && !/Android/.test(userAgent) ? loudspeakers[count]?.split(' ') : undefined;
    return places ? alsa.filter(place => places.includes(place)).map(place => places.indexOf(place)) : Array.from({ length: count }, (_, i) => i);
}

/** Refuses what are no device outputs of so many actuators, from 1; undefined: in order. */
export function expectOutputs(outputs, count, { destination: { maxChannelCount: most } }) {
    if (outputs === undefined) return;
    const isGood = Array.isArray(outputs) && outputs.length === count && new Set(outputs).size === count && outputs.every(output => Number.isInteger(output) && output >= 1 && output <= most);
    if (!isGood) throw new PhysVibError(-2, `outputs: expected ${count} different numbers, 1 to ${most} (outputs of this device), found ${String(outputs)}`);
}

/** Takes the channels of a node to the device: each actuator to an output of its own where there are as many, else all to a stereo monitor. */
export class Route {
    #context; #from; #nodes = []; #most = null; #pans; #outputs;
    /** True if each actuator has an output of its own in the present connection. */
    isDirect = false;
    constructor(context, from) {
        this.#context = context;
        this.#from = from;
    }

    /** `pans`: each actuator's place in the monitor, -1 to 1; `outputs`: as expectOutputs has them. */
    connect(pans, outputs) {
        const context = this.#context, { destination } = context, most = destination.maxChannelCount, split = new ChannelSplitterNode(context, { numberOfOutputs: pans.length });
        this.disconnect();
        [this.#pans, this.#outputs, this.#most] = [pans, outputs, most];
        this.isDirect = outputs ? outputs.every(output => output <= most) : most > 2 && most >= pans.length;
        if (most > 0 && isReal(context)) destination.channelCount = most; // all of them: fewer are loudspeakers, which sound servers spread; WebKit tells none
        destination.channelInterpretation = most > 1 ? 'discrete' : 'speakers';
        this.#nodes = [split, ...(this.isDirect ? [new ChannelMergerNode(context, { numberOfInputs: most })] : pans.map(pan => new StereoPannerNode(context, { pan })))];
        const channels = channelsOfOutputs(most, isReal(context) ? undefined : {});
        this.#from.connect(split);
        pans.forEach((_, j) => (this.isDirect ? split.connect(this.#nodes[1], j, channels[(outputs?.[j] ?? j + 1) - 1]) : split.connect(this.#nodes[1 + j], j)));
        for (const node of this.#nodes.slice(1)) node.connect(destination);
    }
    /** Adapts to a device whose number of outputs may have changed. */
    follow() { if (this.#context.destination.maxChannelCount !== this.#most) this.connect(this.#pans, this.#outputs); }
    disconnect() { for (const node of [this.#from, ...this.#nodes]) node.disconnect(); }
}

/** Whether a device takes what a context plays. `changed()` is called when that, or the device, may be another. A device that was lost and is there again is taken. */
export class Watch {
    #context; #changed; #sink; #timer; #devices = globalThis.navigator?.mediaDevices; #hasRun = false; #hasFailed = false; #looks = 0;
    /** Whether the context runs without a device; and the context's time when it was looked at last. */
    isMissing = false;
    since = 0;
    constructor(context, changed) {
        this.#context = context;
        this.#changed = changed;
        this.#sink = context.sinkId;
        if (!isReal(context)) return;
        this.#listen('addEventListener');
        this.#look({});
    }
    #listen(way) {
        for (const name of ['statechange', 'error', 'sinkchange']) this.#context[way]?.(name, this.#look);
        this.#devices?.[way]?.('devicechange', this.#look);
    }
    end() {
        this.#listen('removeEventListener');
        clearTimeout(this.#timer);
        this.#looks = NaN;
    }

    /** 'running', 'suspended' or 'device lost'. */
    get state() {
        const { state = 'running' } = this.#context;
        if (!isReal(this.#context) || (state === 'running' && !this.isMissing)) return 'running';
        return state === 'suspended' && !this.#hasFailed ? 'suspended' : 'device lost';
    }

    /** Whether it runs within a second; on another device where the one it had is gone. To be called in a click. */
    async resume() {
        const context = this.#context;
        if (this.state === 'device lost' && context.setSinkId && !renewed.has(context)) { // Chromium's context is tied to what is gone, or to a device that it feigns
            renewed.add(context);
            await context.setSinkId({ type: 'none' }).then(() => context.setSinkId(this.#sink)).catch(() => {}); // where there is none, time goes on without
        }
        const isRunning = await soon(context.resume());
        renewed.delete(context);
        if (!isRunning && globalThis.navigator?.userActivation?.hasBeenActive) this.#hasFailed = true; // so no browser waits for a click: Firefox without a device
        await this.#look({});
        return isRunning;
    }

    #look = async ({ type }) => {
        const context = this.#context, look = ++this.#looks, { currentTime } = context;
        if (type === 'error') this.#hasFailed = true;
        else if (context.state === 'running') [this.#hasRun, this.#hasFailed] = [true, false];
        else if (!this.#hasFailed) this.#hasRun = false; // a game's own wish, as is a sink
        if (type === 'sinkchange') this.isMissing = false;
        if (type === 'sinkchange' && !renewed.has(context)) this.#sink = context.sinkId;
        const isThere = await this.#isThere();
        if (look !== this.#looks) return; // a newer one knows better
        this.isMissing = !isThere || context.sinkId?.type === 'none' || (this.isMissing && context.setSinkId !== undefined); // one that was feigned is kept until another is taken
        this.since = currentTime;
        this.#changed();
        clearTimeout(this.#timer);
        if (this.state !== 'device lost' || !context.setSinkId || context.state === 'closed' || this.#sink?.type === 'none') return;
        this.#timer = setTimeout(isThere && this.#hasRun ? () => this.resume() : this.#look, patienceMs, {}); // Chromium does not always say when devices come
    };
    // Chromium runs on without a device, and lists those that there are; Firefox runs on, and answers resume() when there is one.
    async #isThere() {
        const context = this.#context;
        if (context.setSinkId) return (await this.#devices?.enumerateDevices().catch(() => null))?.some(({ kind }) => kind === 'audiooutput') ?? true;
        if (context.state !== 'running') return true;
        const answer = context.resume(), isThere = await soon(answer);
        if (!isThere) answer.then(() => this.#look({}), () => {});
        return isThere;
    }
}

/** 0.3 s of 200 Hz, half of full scale before the level, at one of so many channels: connect it, and start it. */
export function buzzOf(context, channels, channel) {
    const rate = context.sampleRate, length = Math.round(0.3 * rate), buffer = new AudioBuffer({ numberOfChannels: channels, length, sampleRate: rate });
    buffer.copyToChannel(Float32Array.from({ length }, (_, i) => 0.5 * Math.sin(Math.PI * i / length) ** 2 * Math.sin(2 * Math.PI * 200 * i / rate)), channel);
    return new AudioBufferSourceNode(context, { buffer });
}
