// SPDX-License-Identifier: MIT
// Measures what was sent at the last point before the device, block by block, as proof that something was played. Times are seconds of the audio context.
const room = 8192; // blocks: 22 s at 48 kHz
const audible = 1e-5; // of full scale: -100 dB

export class Receipts {
    #channels; #rate; #quantum = 128; #frames = new Float64Array(room).fill(-1); #levels; #strongest = 0;
    /** End of the last audible block, s; null: there was none. */
    last = null;
    constructor(channels, rate) {
        this.#channels = channels;
        this.#rate = rate;
        this.#levels = new Float32Array(2 * channels * room);
    }

    /** Adds peak and mean square of each channel of consecutive blocks, from the meter of worklet.js. */
    add({ frame, quantum, levels }) {
        const each = 2 * this.#channels;
        this.#quantum = quantum;
        for (let i = 0; i < levels.length / each; ++i) {
            const from = frame + i * quantum, slot = (from / quantum) % room, block = levels.subarray(i * each, (i + 1) * each);
            this.#frames[slot] = from;
            this.#levels.set(block, slot * each);
            const peak = block.reduce((most, value, at) => (at % 2 === 0 && value > most ? value : most), 0);
            this.#strongest = Math.max(this.#strongest, peak);
            if (peak > audible) this.last = (from + quantum) / this.#rate;
        }
    }
    /** Marks the output since then as lost, with the device. */
    forget(seconds) {
        this.#frames.forEach((frame, slot) => { if (frame >= seconds * this.#rate) this.#frames[slot] = -1; });
        this.#strongest = 0;
        if (this.last > seconds) this.last = seconds || null;
    }

    /** Measures each channel over the blocks that overlap this interval. */
    left(from, to) {
        const rate = this.#rate / this.#quantum, first = Math.floor(from * rate), end = Math.ceil(to * rate), each = 2 * this.#channels;
        const all = Array.from({ length: this.#channels }, () => ({ frames: 0, peak: 0, meanSquare: 0, running: false }));
        let blocks = 0;
        for (let i = Math.max(first, end - room, 0); i < end; ++i) {
            if (this.#frames[i % room] !== i * this.#quantum) continue;
            ++blocks;
            all.forEach((one, j) => {
                one.peak = Math.max(one.peak, this.#levels[i % room * each + 2 * j]);
                one.meanSquare += this.#levels[i % room * each + 2 * j + 1];
            });
        }
        for (const one of all) Object.assign(one, { frames: blocks * this.#quantum, meanSquare: blocks > 0 ? one.meanSquare / blocks : 0, running: blocks > 0 && blocks === end - first });
        return all;
    }
    /** The largest sample since the last call; 0: nothing audible. */
    takeStrongest() {
        const strongest = this.#strongest > audible ? this.#strongest : 0;
        this.#strongest = 0;
        return strongest;
    }
}
