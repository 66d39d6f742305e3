// SPDX-License-Identifier: MIT
// The audio thread: the whole chain in one WebAssembly instance. Gets inputs by messages, tells poses, hits and levels sixty times a second.
// What it renders is one channel per enchanter; the page's graph makes of them what the device has.
const tellEvery = 1 / 60; // s
const mostHits = 48; // of one message: what an eye can tell apart

class Instance {
    constructor(module) {
        const refuse = () => 52; // a page has no files: "not supported", for what the C library asks
        const system = new Proxy({}, { get: () => refuse });
        const { exports } = new WebAssembly.Instance(module, { page: { fail: at => { throw new Error(this.words(at)); } }, wasi_snapshot_preview1: system });
        this.calls = exports;
        exports._initialize();
    }
    words(at) {
        const bytes = new Uint8Array(this.calls.memory.buffer);
        let text = '';
        for (let end = bytes.indexOf(0, at), i = at; i < end; ++i) text += '%' + bytes[i].toString(16).padStart(2, '0');
        return decodeURIComponent(text); // there is no TextDecoder on this thread
    }
    give(bytes) { new Uint8Array(this.calls.memory.buffer).set(bytes, this.calls.text(bytes.length)); }
    floats(at, count) { return new Float32Array(this.calls.memory.buffer, at, count); }
}

class PhysVib extends AudioWorkletProcessor {
    constructor({ processorOptions, outputChannelCount }) {
        super();
        this.module = new WebAssembly.Module(processorOptions.code); // here: not every browser sends modules to this thread
        this.outputs = outputChannelCount[0];
        this.port.onmessage = ({ data }) => this.obey(data);
        this.open(processorOptions.first);
        const list = this.instance ?? new Instance(this.module);
        this.port.postMessage({ scenes: list.words(list.calls.sceneList()).trim().split('\n') });
    }

    // A scene that is refused leaves its instance behind; the one that plays goes on.
    open(wanted) {
        try {
            const next = new Instance(this.module);
            next.give(wanted.bytes);
            next.calls.open(wanted.isName, wanted.byHand, wanted.seed, sampleRate, this.outputs);
            this.instance = next;
            this.place(wanted.places);
            this.forget();
            this.tellScene();
        } catch (error) {
            const why = error instanceof WebAssembly.RuntimeError ? 'expected a scene that a page can hold, found more' : error.message;
            this.port.postMessage({ fault: wanted.name + ': ' + why });
        }
    }

    obey(message) {
        if (message.open) return this.open(message.open);
        const calls = this.instance?.calls;
        if (!calls) return;
        try {
            for (const [name, values] of Object.entries(message)) {
                if (name === 'places') this.place(values);
                else calls[name](...values);
            }
            const fault = this.instance.words(calls.fault());
            if (fault) this.port.postMessage({ fault });
        } catch (error) {
            this.end(error);
        }
    }

    place(places) {
        const { calls } = this.instance;
        calls.enchanters(places.length);
        places.forEach(([x, y], i) => calls.place(i, x, y));
        calls.placed();
        if (this.count !== places.length) this.blocks = []; // one message tells of one number of enchanters
        this.count = places.length;
    }

    end(error) {
        this.instance = null;
        this.port.postMessage({ fault: 'the world has stopped: ' + error.message });
    }

    tellScene() {
        this.port.postMessage({ scene: this.instance.words(this.instance.calls.scene()), isPlayed: !!this.instance.calls.isPlayed() });
    }

    forget() {
        this.toldAt = currentTime;
        this.blocks = [];
        this.hits = [];
    }

    process(inputs, [out]) {
        if (!this.instance) return true;
        const { calls } = this.instance, frames = out[0].length;
        try {
            const samples = this.instance.floats(calls.render(frames), frames * this.outputs);
            out.forEach((channel, j) => channel.set(samples.subarray(j * frames, (j + 1) * frames)));
            this.note(samples, frames);
            if (currentTime - this.toldAt >= tellEvery) this.tell();
        } catch (error) {
            this.end(error);
        }
        return true;
    }

    // Lowest and highest sample of each enchanter, a pair per block.
    note(samples, frames) {
        for (let j = 0; j < this.count; ++j) {
            let low = 0, high = 0;
            for (let i = j * frames; i < (j + 1) * frames; ++i) {
                const value = samples[i];
                if (value < low) low = value;
                else if (value > high) high = value;
            }
            this.blocks.push(low, high);
        }
    }

    tell() {
        const { calls } = this.instance;
        for (let at = calls.hit(); at; at = calls.hit())
            if (this.hits.length < mostHits) this.hits.push([...this.instance.floats(at, 5)]);
        const poses = this.instance.floats(calls.poses(), 4 * calls.bodyCount()).slice();
        this.port.postMessage({ poses, hits: this.hits, blocks: new Float32Array(this.blocks), count: this.count });
        this.forget();
    }
}
registerProcessor('physvib', PhysVib);
