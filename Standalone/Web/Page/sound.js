// SPDX-License-Identifier: MIT
// Takes actuator channels to the device, by the package's own routes: one output each if there are enough, else a stereo monitor panned by their places.
import { Route, Watch, buzzOf, expectOutputs } from './device.js';
import { mostEnchanters } from './link.js';

export const firstLevel = 0.25; // 12 dB below full scale: hands and ears may be attached
const rampSeconds = 0.0015; // time constant: 58 dB within 10 ms, and still no click

/// Returns the reason why sound is not possible here, in a sentence; empty if it is possible.
export function silentBecause() {
    if (globalThis.isSecureContext === false) // browsers give audio worklets to https and to the machine itself only
        return 'No sound here: this page came by http; browsers give sound and vibration to https only. On the computer that serves it, run Standalone/Web/serve.py.';
    return globalThis.AudioWorkletNode && globalThis.WebAssembly ? '' : 'No sound here: this browser has no audio worklets. Firefox 114, Chrome 90, Safari 15 and newer have them.';
}

export class Sound {
    #context; #node; #mix; #master; #route; #watch; #outputs; #connected; #isPaused = false; #firstOutputs;
    /// `onState`: called when what `state` or `isDirect` say may have changed.
    constructor(onTold, onState) { Object.assign(this, { onTold, onState }); }

    /// To be called on a click. `code`: the WebAssembly in bytes; `first`: the first scene. False: no device has answered within a second; onState tells when one does.
    async start(code, first) {
        const why = silentBecause();
        if (why) throw new Error(why);
        this.#watch?.end();
        this.#context?.close(); // of Firefox, which found no device: it never finds one
        const context = this.#context = new AudioContext({ latencyHint: 'interactive' });
        this.#firstOutputs = this.outputs;
        this.#watch = new Watch(context, () => this.#changed());
        const isRunning = this.#watch.resume(); // must happen within the click
        await context.audioWorklet.addModule('worklet.js');
        const node = this.#node = new AudioWorkletNode(context, 'physvib', { numberOfInputs: 0, outputChannelCount: [mostEnchanters], processorOptions: { code, first } });
        node.port.onmessage = ({ data }) => this.onTold(data);
        node.onprocessorerror = () => this.onTold({ fault: 'the sound has stopped; load the page again' });
        const each = { channelCount: mostEnchanters, channelCountMode: 'explicit', channelInterpretation: 'discrete' };
        this.#mix = new GainNode(context, each);
        this.#master = new GainNode(context, { ...each, gain: firstLevel });
        node.connect(this.#mix).connect(this.#master);
        this.#route = new Route(context, this.#master);
        this.#connected = '';
        this.connect(first.places);
        return isRunning;
    }

    get outputs() { return this.#context.destination.maxChannelCount; }
    get rate() { return this.#context.sampleRate; }
    get isDirect() { return this.#route.isDirect; }
    /// 'running', 'suspended' or 'device lost'.
    get state() { return this.#watch.state; }

    /// True if a device has appeared since a start without one: start again.
    get isLate() { return this.#firstOutputs === 0 && this.outputs > 0; }

    #changed() {
        this.#route?.follow();
        if (this.#isPaused && this.#context.state === 'running') this.#context.suspend(); // its device is back
        this.onState();
    }
    connect(places) {
        if (this.#connected === String(places)) return;
        this.#connected = String(places);
        if (this.#outputs?.length !== places.length) this.#outputs = undefined; // they were of another number of actuators
        this.#route.connect(places.map(([x]) => 2 * x - 1), this.#outputs);
    }
    /// The device output of each actuator, from 1; undefined: in order.
    setOutputs(outputs, places) {
        expectOutputs(outputs, places.length, this.#context);
        this.#outputs = outputs;
        this.#connected = '';
        this.connect(places);
    }
    /// Plays 0.3 s of a tone at one actuator.
    buzz(actuator) {
        const source = buzzOf(this.#context, mostEnchanters, actuator);
        source.connect(this.#mix);
        source.start();
    }

    tell(message, given) { this.#node?.port.postMessage(message, given); }
    setLevel(gain) { this.#master?.gain.setTargetAtTime(gain, this.#context.currentTime, rampSeconds); }
    resume() { return this.#watch.resume(); }
    pause(isPaused) { return (this.#isPaused = isPaused) ? this.#context.suspend() : this.resume(); }
}
