// SPDX-License-Identifier: MIT
// Routes actuator channels to the device: one output each if there are enough, else a stereo monitor panned by their places.
export const mostEnchanters = 8;
export const firstLevel = 0.25; // 12 dB below full scale: hands and ears may be attached
const rampSeconds = 0.0015; // time constant: 58 dB within 10 ms, and still no click

/// Why sound is not possible here, in a sentence; empty if it is.
export function silentBecause() {
    if (globalThis.isSecureContext === false) // browsers give audio worklets to https and to the machine itself only
        return 'No sound here: this page came by http; browsers give sound and vibration to https only. On the computer that serves it, run Standalone/Web/serve.py.';
    return globalThis.AudioWorkletNode && globalThis.WebAssembly ? '' : 'No sound here: this browser has no audio worklets. Firefox 114, Chrome 90, Safari 15 and newer have them.';
}

export class Sound {
    #context; #node; #master; #pans = []; #connected = '';
    constructor(onTold) { this.onTold = onTold; }

    /// To be called on a click. `code`: the WebAssembly in bytes; `first`: the first scene.
    async start(code, first) {
        const why = silentBecause();
        if (why) throw new Error(why);
        const context = this.#context = new AudioContext({ latencyHint: 'interactive' }), running = context.resume(); // while it is a click's doing
        await context.audioWorklet.addModule('worklet.js');
        const node = this.#node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [mostEnchanters], processorOptions: { code, first } });
        node.port.onmessage = ({ data }) => this.onTold(data);
        node.onprocessorerror = () => this.onTold({ fault: 'the sound has stopped; load the page again' });
        this.#master = new GainNode(context, { gain: firstLevel });
        this.connect(first.places);
        await running;
    }

    get outputs() { return this.#context.destination.maxChannelCount; }
    get rate() { return this.#context.sampleRate; }

    /// True if each of that number of actuators has an output.
    isDirect(count) { return this.outputs >= count && this.outputs > 2; }

    connect(places) {
        if (this.#connected === String(places)) return;
        this.#connected = String(places);
        const destination = this.#context.destination, direct = this.isDirect(places.length), width = direct ? places.length : 2;
        for (const node of [this.#node, this.#master, ...this.#pans]) node.disconnect();
        if (this.outputs > 0) destination.channelCount = Math.min(width, this.outputs); // WebKit tells none
        destination.channelInterpretation = 'discrete';
        Object.assign(this.#master, { channelCount: width, channelCountMode: 'explicit', channelInterpretation: direct ? 'discrete' : 'speakers' });
        this.#master.connect(destination);
        this.#pans = [];
        if (direct) return void this.#node.connect(this.#master);
        const split = new ChannelSplitterNode(this.#context, { numberOfOutputs: mostEnchanters });
        this.#node.connect(split);
        this.#pans = [split];
        places.forEach(([x], j) => {
            const pan = new StereoPannerNode(this.#context, { pan: 2 * x - 1 });
            split.connect(pan, j);
            pan.connect(this.#master);
            this.#pans.push(pan);
        });
    }

    tell(message, given) { this.#node?.port.postMessage(message, given); }
    setLevel(gain) { this.#master?.gain.setTargetAtTime(gain, this.#context.currentTime, rampSeconds); }
    pause(isPaused) { return isPaused ? this.#context.suspend() : this.#context.resume(); }
}
