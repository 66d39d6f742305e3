// SPDX-License-Identifier: MIT
// From the enchanters to the device: each its own output where there are as many, else a stereo monitor by their places.
export const mostEnchanters = 8;
const firstLevel = 0.25; // 12 dB below full scale: hands and ears may be attached
const rampSeconds = 0.0015; // time constant: 58 dB within 10 ms, and still no click

export class Sound {
    #context; #node; #master; #pans = [];
    constructor(onTold) { this.onTold = onTold; }

    /// On a click. `first`: the scene to begin with.
    async start(first) {
        if (globalThis.isSecureContext === false) { // browsers give audio worklets to https and to the machine itself only
            throw new Error('this page came by http. Serve its folder by https, or open it on the machine that serves it: python3 -m http.server --bind 127.0.0.1, then http://127.0.0.1:8000');
        }
        const context = this.#context = new AudioContext({ latencyHint: 'interactive' }), running = context.resume(); // while it is a click's doing
        const fetched = async () => (await fetch('physvib.wasm')).arrayBuffer();
        const [code] = await Promise.all([fetched(), context.audioWorklet.addModule('worklet.js')]);
        const node = this.#node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [mostEnchanters], processorOptions: { code, first } });
        node.port.onmessage = ({ data }) => this.onTold(data);
        node.onprocessorerror = () => this.onTold({ fault: 'the sound has stopped; load the page again' });
        this.#master = new GainNode(context, { gain: firstLevel });
        this.connect(first.places);
        await running;
    }

    get outputs() { return this.#context.destination.maxChannelCount; }
    get rate() { return this.#context.sampleRate; }

    /// Whether each of so many enchanters has an output.
    isDirect(count) { return this.outputs >= count && this.outputs > 2; }

    connect(places) {
        const destination = this.#context.destination, direct = this.isDirect(places.length), width = direct ? places.length : 2;
        for (const node of [this.#node, this.#master, ...this.#pans]) node.disconnect();
        destination.channelCount = Math.min(width, this.outputs);
        destination.channelInterpretation = 'discrete';
        Object.assign(this.#master, { channelCount: width, channelCountMode: 'explicit', channelInterpretation: direct ? 'discrete' : 'speakers' });
        this.#master.connect(destination);
        this.#pans = [];
        if (direct) return this.#node.connect(this.#master);
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

    tell(message) { this.#node?.port.postMessage(message); }
    setLevel(gain) { this.#master?.gain.setTargetAtTime(gain, this.#context.currentTime, rampSeconds); }
    pause(isPaused) { return isPaused ? this.#context.suspend() : this.#context.resume(); }
}
