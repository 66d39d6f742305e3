// SPDX-License-Identifier: MIT
// An audio context of tests: its time goes by quanta that a test runs, and its device is what the test says. The graph is computed as Web Audio has it, but for ramps, which end at once.
import vm from 'node:vm';

export const rate = 48000, quantum = 128;

class Node {
    sources = []; targets = new Set(); frame = -1;
    constructor(context, options = {}) { Object.assign(this, { context, options }); }
    connect(to, output = 0, input = 0) {
        if (input >= to.inputs) throw new Error(`IndexSizeError: input ${input} of ${to.inputs}`);
        to.sources.push({ from: this, output, input });
        this.targets.add(to);
        return to;
    }
    disconnect() {
        for (const to of this.targets) to.sources = to.sources.filter(({ from }) => from !== this);
        this.targets.clear();
    }
    get inputs() { return 1; }
    /** The channels of that output in this quantum. */
    pull(output) {
        const { context } = this;
        if (this.frame !== context.frame) [this.frame, this.out] = [context.frame, this.render()];
        return this.out[output];
    }
    gather(input = 0) {
        const sum = [];
        for (const source of this.sources.filter(one => one.input === input)) source.from.pull(source.output).forEach((channel, j) => { sum[j] = sum[j] ? sum[j].map((value, i) => value + channel[i]) : Float32Array.from(channel); });
        return sum;
    }
}
class GainNode extends Node {
    constructor(context, options) {
        super(context, options);
        this.gain = { value: options?.gain ?? 1, setTargetAtTime: value => { this.gain.value = value; } };
    }
    render() { return [this.gather().map(channel => channel.map(value => value * this.gain.value))]; }
}
class ChannelSplitterNode extends Node {
    render() {
        const from = this.gather();
        return Array.from({ length: this.options.numberOfOutputs }, (_, j) => [from[j] ?? new Float32Array(quantum)]);
    }
}
class ChannelMergerNode extends Node {
    get inputs() { return this.options.numberOfInputs; }
    render() { return [Array.from({ length: this.inputs }, (_, j) => this.gather(j)[0] ?? new Float32Array(quantum))]; }
}
class StereoPannerNode extends Node {
    render() {
        const angle = (this.options.pan + 1) * Math.PI / 4, [mono = new Float32Array(quantum)] = this.gather();
        return [[mono.map(value => value * Math.cos(angle)), mono.map(value => value * Math.sin(angle))]];
    }
}
class AudioBuffer {
    constructor({ numberOfChannels, length }) { this.channels = Array.from({ length: numberOfChannels }, () => new Float32Array(length)); }
    copyToChannel(samples, j) { this.channels[j].set(samples); }
}
class AudioBufferSourceNode extends Node {
    start(seconds = 0) { this.startFrame = Math.max(Math.round(seconds * rate), this.context.frame); }
    render() {
        const at = this.context.frame - this.startFrame, { channels } = this.options.buffer;
        if (at >= channels[0].length && !this.isOver) {
            this.isOver = true;
            queueMicrotask(() => this.onended?.());
        }
        return [channels.map(channel => Float32Array.from({ length: quantum }, (_, i) => channel[at + i] ?? 0))];
    }
}
class AudioWorkletNode extends Node {
    constructor(context, name, options) {
        super(context, options);
        const inside = { postMessage: data => queueMicrotask(() => this.port.onmessage?.({ data })) };
        this.port = { postMessage: data => inside.onmessage({ data: structuredClone(data) }) };
        context.port = inside;
        this.processor = new context.processors[name](options);
        if (name === 'physvib') context.physvib = this;
    }
    render() {
        const out = Array.from({ length: this.options.outputChannelCount[0] }, () => new Float32Array(quantum));
        this.isAlive = this.processor.process([this.gather()], [out]);
        return [out];
    }
}
class Destination extends Node {
    channelCount = 2;
    constructor(context, most) {
        super(context);
        this.maxChannelCount = most;
    }
    render() {
        const from = this.gather();
        return [Array.from({ length: this.channelCount }, (_, j) => from[j] ?? new Float32Array(quantum))];
    }
}
Object.assign(globalThis, { GainNode, ChannelSplitterNode, ChannelMergerNode, StereoPannerNode, AudioBuffer, AudioBufferSourceNode, AudioWorkletNode });

/** `code`: the text of worklet.js; `outputs`: of the device. */
export class Context extends EventTarget {
    frame = 0; sampleRate = rate; recorded = []; heard = []; processors = {}; #state = 'running';
    constructor(code, outputs) {
        super();
        this.destination = new Destination(this, outputs);
        this.audioWorklet = { addModule: async () => this.#read(code) };
    }
    #read(code) {
        const context = this;
        vm.runInContext(code, vm.createContext({ WebAssembly, sampleRate: rate, AudioWorkletProcessor: class { constructor() { this.port = context.port; } },
            registerProcessor: (name, processor) => { context.processors[name] = processor; }, get currentFrame() { return context.frame; } }));
    }
    get state() { return this.#state; }
    set state(state) {
        if (state === this.#state) return;
        this.#state = state;
        this.dispatchEvent(new Event('statechange'));
    }
    get currentTime() { return this.frame / rate; }
    async resume() { this.state = 'running'; }
    get isAlive() { return this.physvib.isAlive; }
    get processor() { return this.physvib.processor; }
    /** `recorded`: what the renderer gives, before the level; `heard`: what each output of the device gets. */
    run(quanta) {
        for (let i = 0; i < quanta; ++i) {
            const out = this.destination.pull(0), { physvib } = this;
            (physvib.frame === this.frame ? physvib.out[0] : (physvib.frame = this.frame, physvib.out = physvib.render())[0]).forEach((channel, j) => (this.recorded[j] ??= []).push(...channel));
            out.forEach((channel, j) => (this.heard[j] ??= []).push(...channel));
            this.frame += quantum;
        }
    }
    /** The peak of each output since that many frames. */
    peaks(since = 0) { return this.heard.map(channel => channel.slice(since).reduce((most, value) => Math.max(most, Math.abs(value)), 0)); }
}
