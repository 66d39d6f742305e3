// SPDX-License-Identifier: MIT
// Renderer, which turns events into samples, one channel per actuator.
import { impactOf } from './impact.js';
import { channelsOf, withSettings } from './settings.js';

const nsOf = time => BigInt(Math.round(time));

export class Renderer {
    #module; #memory = { at: 0, frames: 0 }; #forget;

    constructor(module, registry, settings = {}) {
        this.#module = module;
        const made = withSettings(module, settings, at => ({ channels: channelsOf(module, at), rate: module.get('renderer_settings', at).rate, name: module.handleOf(to => module.call('renderer_create', at, to)) }));
        Object.assign(this, made); // name: of this renderer in the module
        const { name } = made, memory = this.#memory;
        this.#forget = registry(this, () => {
            module.call('renderer_free', name);
            if (memory.at) module.free(memory.at);
        });
    }

    strike(event) { this.#module.withEvents([event], at => this.#module.call('renderer_strike', this.name, at)); }

    /** One impact at the next pull: { x, y, strength, material }. */
    impact(hit) { this.strike({ ...impactOf(hit), timeNs: Math.ceil(this.status.frames * 1e9 / this.rate) }); }

    /** The next samples: so many frames, a Float32Array per channel; or into arrays of yours, which allocates nothing. */
    pull(into) {
        const isCount = typeof into === 'number', frames = isCount ? into : into[0].length, { channels } = this, module = this.#module;
        if (frames > this.#memory.frames) this.#makeRoom(frames);
        module.call('renderer_pull', this.name, this.#memory.at, channels, frames);
        if (isCount) return Array.from({ length: channels }, (_, j) => module.floats(this.#samplesOf(j), frames).slice());
        for (let j = 0; j < channels; ++j) into[j].set(module.floats(this.#samplesOf(j), frames));
        return into;
    }
    #samplesOf(channel) { return this.#memory.at + 4 * this.channels + 4 * channel * this.#memory.frames; }
    #makeRoom(frames) {
        if (this.#memory.at) this.#module.free(this.#memory.at);
        this.#memory.at = 0;
        this.#memory.at = this.#module.room(4 * this.channels * (1 + frames));
        this.#memory.frames = frames;
        for (let j = 0; j < this.channels; ++j) this.#module.view.setUint32(this.#memory.at + 4 * j, this.#samplesOf(j), true);
    }

    setGain(timeNs, channel, gain) { this.#module.call('renderer_set_gain', this.name, nsOf(timeNs), channel, gain); }
    setMute(timeNs, channel, isMuted) { this.#module.call('renderer_set_mute', this.name, nsOf(timeNs), channel, isMuted ? 1 : 0); }
    setLevel(timeNs, gain) { this.#module.call('renderer_set_level', this.name, nsOf(timeNs), gain); }
    setLayout(timeNs, settings) { withSettings(this.#module, settings, at => this.#module.call('renderer_set_layout', this.name, nsOf(timeNs), at)); }
    silence(timeNs, untilNs) { this.#module.call('renderer_silence', this.name, nsOf(timeNs), nsOf(untilNs)); }
    get latencyFrames() { return this.#module.call('renderer_latency_frames', this.name); }
    get status() {
        return this.#module.filled('renderer_status', {}, at => {
            this.#module.call('renderer_get_status', this.name, at);
            return this.#module.get('renderer_status', at);
        });
    }

    free() { this.#forget(); }
}
