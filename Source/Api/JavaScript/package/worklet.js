// SPDX-License-Identifier: MIT
// The audio thread: one renderer in a module instance of its own. It imports nothing, so that bundlers may copy it unchanged. It receives structures of physvib.h
// as bytes, and calls by name.
const mostSkipped = 32; // quanta that are made up for in one: 1 ms of work

class PhysVibProcessor extends AudioWorkletProcessor {
    constructor({ processorOptions: { module, code, settings, channels, eventBytes, timeAt, statusBytes } }) {
        super();
        const compiled = module ?? new WebAssembly.Module(code); // not every browser sends modules to this thread
        const system = new Proxy({}, { get: () => () => 52 }), { exports } = new WebAssembly.Instance(compiled, { physvib: { fail: () => { throw new Error('internal'); } }, wasi_snapshot_preview1: system });
        this.lib = exports;
        this.lib._initialize();
        this.channels = channels;
        this.eventBytes = eventBytes;
        this.timeAt = timeAt;
        this.quantum = 0; // frames that there is room for
        const at = this.lib.malloc(4);
        this.given(settings, from => this.lib.physvib_renderer_create(from, at));
        this.renderer = new DataView(this.lib.memory.buffer).getUint32(at, true);
        this.lib.free(at);
        this.status = this.lib.malloc(statusBytes);
        this.lib.physvib_renderer_status_init(this.status, statusBytes);
        this.statusBytes = statusBytes;
        this.firstFrame = null;
        this.pulled = this.skipped = 0; // frames, since the first
        this.toldFrame = 0;
        this.isOpen = this.renderer !== 0;
        this.port.onmessage = ({ data }) => this.guarded(() => this.obey(data));
        this.port.postMessage({ isOpen: this.isOpen, latencyFrames: this.isOpen ? this.lib.physvib_renderer_latency_frames(this.renderer) : 0 });
    }

    // An error is reported and ends this processor.
    guarded(work) {
        try {
            return work();
        } catch (error) {
            this.isOpen = false;
            this.port.postMessage({ error: error.message });
            return false;
        }
    }

    given(bytes, use) {
        const at = this.lib.malloc(bytes.length);
        new Uint8Array(this.lib.memory.buffer).set(bytes, at);
        const result = use(at);
        this.lib.free(at);
        return result;
    }

    // Times are those of the context; the renderer counts from its first frame.
    obey({ close, startFrame, events, nowNs, call, timeNs, values = [], settings, isAsked }) {
        if (isAsked) {
            this.port.postMessage({ hasArrived: true });
            return;
        }
        if (close) {
            if (this.isOpen) this.lib.physvib_renderer_free(this.renderer);
            this.isOpen = false;
            return;
        }
        if (!this.isOpen) return;
        this.firstFrame ??= startFrame ?? currentFrame;
        const offset = BigInt(Math.round(this.firstFrame * 1e9 / sampleRate)), after = ns => { const time = BigInt(Math.round(ns)) - offset; return time > 0n ? time : 0n; };
        const behindNs = nowNs === undefined ? 0 : Math.max(0, currentFrame * 1e9 / sampleRate - nowNs); // of what was meant for now, while its message came
        if (events) this.given(events, at => this.strike(at, events.length / this.eventBytes, ns => after(ns + behindNs)));
        else {
            const act = (...all) => this.lib[`physvib_renderer_${call}`](this.renderer, after(timeNs), ...all);
            const code = settings ? this.given(settings, act) : act(...values.map(value => (call === 'silence' ? after(value) : value)));
            if (code < 0) this.port.postMessage({ refused: call });
        }
    }

    strike(at, count, after) {
        for (let i = 0; i < count; ++i) {
            const event = at + i * this.eventBytes, time = event + this.timeAt, view = new DataView(this.lib.memory.buffer);
            view.setBigInt64(time, after(Number(view.getBigInt64(time, true))), true);
            if (this.lib.physvib_renderer_strike(this.renderer, event) === -2) this.port.postMessage({ refused: 'an event' });
        }
    }

    makeRoom(frames) {
        if (this.quantum) this.lib.free(this.room);
        this.quantum = frames;
        this.room = this.lib.malloc(4 * this.channels * (1 + frames));
        const view = new DataView(this.lib.memory.buffer);
        for (let j = 0; j < this.channels; ++j) view.setUint32(this.room + 4 * j, this.room + 4 * (this.channels + j * frames), true);
    }

    pull(frames) {
        this.lib.physvib_renderer_pull(this.renderer, this.room, this.channels, frames);
        this.pulled += frames;
    }

    process(inputs, [out]) { return this.isOpen && this.guarded(() => this.play(out)); }

    play(out) {
        const frames = out[0].length;
        this.firstFrame ??= currentFrame;
        if (frames !== this.quantum) this.makeRoom(frames);
        // The browser leaves quanta out while this thread stands still, as it does for another module. They are over: the renderer's frames are the context's.
        for (let i = 0; i < mostSkipped && this.pulled < currentFrame - this.firstFrame; ++i) {
            this.pull(frames);
            this.skipped += frames;
        }
        this.pull(frames);
        const samples = new Float32Array(this.lib.memory.buffer, this.room + 4 * this.channels, this.channels * frames);
        for (let j = 0; j < out.length && j < this.channels; ++j) out[j].set(samples.subarray(j * frames, (j + 1) * frames));
        if (currentFrame - this.toldFrame > sampleRate / 4) {
            this.toldFrame = currentFrame;
            this.lib.physvib_renderer_get_status(this.renderer, this.status);
            this.port.postMessage({ status: new Uint8Array(this.lib.memory.buffer, this.status, this.statusBytes).slice(), skipped: this.skipped });
        }
        return true;
    }
}
registerProcessor('physvib', PhysVibProcessor);

// The last point before the device: hands on what it gets, and tells peak and mean square of each channel of each block.
const blocksAtOnce = 16; // 43 ms at 48 kHz
class PhysVibMeter extends AudioWorkletProcessor {
    constructor({ outputChannelCount: [channels] }) {
        super();
        this.levels = new Float32Array(2 * channels * blocksAtOnce);
        this.filled = 0; // of them
        this.isOpen = true;
        this.port.onmessage = () => { this.isOpen = false; };
    }

    process([channels], [out]) {
        const quantum = out[0].length, isNext = currentFrame === this.nextFrame; // the browser leaves quanta out at times
        if (this.filled > 0 && !isNext) this.tell(quantum);
        this.nextFrame = currentFrame + quantum;
        out.forEach((to, j) => {
            let peak = 0, sum = 0;
            const samples = channels[j] ?? to; // silence where nothing is connected
            for (let i = 0; i < quantum; ++i) {
                const value = samples[i], size = value < 0 ? -value : value;
                if (size > peak) peak = size;
                sum += value * value;
            }
            if (samples !== to) to.set(samples);
            this.levels[this.filled++] = peak;
            this.levels[this.filled++] = sum / quantum;
        });
        if (this.filled === this.levels.length) this.tell(quantum);
        return this.isOpen;
    }
    tell(quantum) {
        const frame = this.nextFrame - quantum * this.filled / this.levels.length * blocksAtOnce;
        this.port.postMessage({ frame, quantum, levels: this.levels.slice(0, this.filled) });
        this.filled = 0;
    }
}
registerProcessor('physvib-meter', PhysVibMeter);
