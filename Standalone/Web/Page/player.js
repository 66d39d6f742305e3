// SPDX-License-Identifier: MIT
// Runs a world and renders its samples: on the audio thread, or before the first click in the page's own thread without sound. All of it is
// one WebAssembly instance, which gets inputs by messages, and reports poses, impacts and levels sixty times a second.
import { Module } from './module.js';

const reportsPerSecond = 60;
const mostHits = 200; // of one report

export class Player {
    #report = null; #recording = null;

    /// `post` receives reports, and the objects in them that are transferred.
    constructor(compiled, rate, outputs, post) {
        Object.assign(this, { compiled, rate, outputs, post });
    }

    /// Lists that do not depend on a scene.
    lists() {
        const module = new Module(this.compiled), linesOf = name => module.text(module.run(name)).trim().split('\n');
        return { scenes: linesOf('sceneList'), laws: linesOf('lawList') };
    }

    /// Opens a world. If it is invalid, its instance is discarded, and the current world continues.
    open(wanted) {
        try {
            const next = new Module(this.compiled), { name, bytes, isName, byHand, seed, variables, materials, field } = wanted;
            for (const [variable, value] of variables) next.withText(variable, n => next.withText(value, v => next.run('choose', n, v)));
            next.withText(name, called => next.withBytes(bytes, (at, count) =>
                next.run('open', called, at, isName ? -1 : count, byHand, seed, this.rate, this.outputs, ...field)));
            for (const [index, [frequency, decay]] of materials) {
                next.run('sound', index, frequency, decay);
                const fault = next.text(next.run('fault'));
                if (fault) throw new Error(fault);
            }
            this.module = next;
            this.place(wanted);
            this.frame = this.reportedFrame = 0;
            if (this.#recording) this.#endRecording(null);
            this.#forget();
            this.post({ key: wanted.key, scene: next.text(next.run('scene')), variables: next.text(next.run('variables')), isPlayed: !!next.run('isPlayed') });
            this.#send(); // so that a paused world is displayed
        } catch (error) {
            const why = error.message.startsWith('internal:') ? 'expected a scene that a page can hold, found more' : error.message;
            this.post({ fault: why.startsWith(wanted.name) ? why : `${wanted.name}: ${why}` });
        }
    }

    obey(message) {
        if (message.open) return this.open(message.open);
        if (!this.module) return;
        try {
            for (const [name, values] of Object.entries(message)) {
                if (name === 'placed') this.place(values);
                else if (name === 'record') this.#begin(values);
                else this.module.run(name, ...values);
            }
            const fault = this.module.text(this.module.run('fault'));
            if (fault) this.post({ fault });
        } catch (error) {
            this.#end(error);
        }
    }

    place({ places, law }) {
        const { module } = this;
        module.run('enchanters', places.length);
        places.forEach(([x, y], i) => module.run('place', i, x, y));
        module.run('placed', law);
        if (this.count === places.length) return;
        this.count = places.length;
        this.#forget(); // a report and a recording have one number of actuators
        if (this.#recording) this.#endRecording(null);
    }

    /// The next frames, output by output; null if there is no world.
    render(frames) {
        if (!this.module) return null;
        try {
            const samples = this.module.floats(this.module.run('render', frames), frames * this.outputs);
            this.frame += frames;
            this.#note(samples, frames);
            if (this.#recording) this.#record(samples, frames);
            if (this.frame - this.reportedFrame >= this.rate / reportsPerSecond) this.#send();
            return samples;
        } catch (error) {
            this.#end(error);
            return null;
        }
    }

    #end(error) {
        this.module = null;
        this.post({ fault: `the world has stopped: ${error.message}` });
    }

    #forget() {
        this.#report = { blocks: [], hits: [] };
    }

    // Stores minimum and maximum of each actuator, one pair per block.
    #note(samples, frames) {
        for (let j = 0; j < this.count; ++j) {
            let low = 0, high = 0;
            for (let i = j * frames; i < (j + 1) * frames; ++i) {
                const value = samples[i];
                if (value < low) low = value;
                else if (value > high) high = value;
            }
            this.#report.blocks.push(low, high);
        }
    }

    #begin(channels) {
        this.#takeHits(); // earlier impacts do not belong to the recording
        this.#recording = { channels, frames: 0, hits: [], since: this.frame / this.rate };
    }
    #record(samples, frames) {
        const { channels, frames: done } = this.#recording, count = Math.min(frames, channels[0].length - done);
        channels.forEach((channel, j) => channel.set(samples.subarray(j * frames, j * frames + count), done));
        this.#recording.frames += count;
        if (this.#recording.frames < channels[0].length) return;
        this.#takeHits();
        this.#endRecording({ channels, rate: this.rate, hits: this.#recording.hits, since: this.#recording.since });
    }
    #endRecording(recorded) {
        this.post({ recorded }, recorded?.channels.map(channel => channel.buffer));
        this.#recording = null;
    }

    #takeHits() {
        const { module } = this, { hits } = this.#report;
        for (let at = module.run('hit'); at; at = module.run('hit')) {
            const hit = [...module.doubles(at, 8)];
            if (hits.length < mostHits) hits.push(hit);
            this.#recording?.hits.push(hit);
        }
    }

    #send() {
        this.#takeHits();
        const { module } = this, { hits, blocks } = this.#report;
        const poses = module.floats(module.run('poses'), 4 * module.run('bodyCount')).slice();
        this.post({ poses, hits, blocks: new Float32Array(blocks), count: this.count, seconds: this.frame / this.rate });
        this.reportedFrame = this.frame;
        this.#forget();
    }
}
