// SPDX-License-Identifier: MIT
// Scope of the last second and a half of each actuator. Heights are square roots of levels, so that weak impacts are visible.
import * as look from './look.js';

const columns = 600; // blocks of 128 frames: 1.6 s at 48 kHz
const root = value => Math.sign(value) * Math.sqrt(Math.min(1, Math.abs(value)));

export class Scope {
    #traces = [];
    constructor(canvas) { this.canvas = canvas; }

    add(blocks, count) {
        if (this.#traces.length !== count) this.#traces = Array.from({ length: count }, () => new Float32Array(2 * columns));
        const added = blocks.length / 2 / count;
        this.#traces.forEach((trace, j) => {
            trace.copyWithin(0, 2 * added);
            for (let i = 0; i < added; ++i) trace.set(blocks.subarray(2 * (i * count + j), 2 * (i * count + j) + 2), trace.length - 2 * (added - i));
        });
    }

    draw() {
        const context = look.fresh(this.canvas), gap = 6, label = 22, { clientWidth: width, clientHeight } = this.canvas;
        const height = (clientHeight - gap * (this.#traces.length - 1)) / this.#traces.length;
        context.font = '600 13px system-ui, sans-serif';
        context.textBaseline = 'middle';
        this.#traces.forEach((trace, j) => {
            const top = j * (height + gap), middle = top + height / 2;
            context.fillStyle = look.ground;
            context.fillRect(label, top, width - label, height);
            context.fillStyle = context.strokeStyle = look.enchanterColours[j];
            context.fillText(look.letter(j), 2, middle);
            context.beginPath();
            for (let i = 0; i < columns; ++i) {
                const x = label + ((i + 0.5) * (width - label)) / columns, low = root(trace[2 * i]), high = root(trace[2 * i + 1]);
                context.moveTo(x, middle - (high * height) / 2 - 0.5);
                context.lineTo(x, middle - (low * height) / 2 + 0.5);
            }
            context.stroke();
        });
    }
}
