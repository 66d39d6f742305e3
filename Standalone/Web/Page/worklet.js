// SPDX-License-Identifier: MIT
// Audio thread: runs a player with one channel per actuator. The audio graph of the page maps the channels to the device.
import { Player } from './player.js';

class PhysVib extends AudioWorkletProcessor {
    constructor({ processorOptions: { code, first }, outputChannelCount: [outputs] }) {
        super();
        this.player = new Player(new WebAssembly.Module(code), sampleRate, outputs, (message, given) => this.port.postMessage(message, given)); // compiled here, because not every browser sends modules to this thread
        this.port.onmessage = ({ data }) => this.player.obey(data);
        this.player.open(first);
    }

    process(inputs, [out]) {
        const frames = out[0].length, samples = this.player.render(frames);
        if (samples) out.forEach((channel, j) => channel.set(samples.subarray(j * frames, (j + 1) * frames)));
        return true;
    }
}
registerProcessor('physvib', PhysVib);
