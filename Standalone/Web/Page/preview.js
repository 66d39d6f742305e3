// SPDX-License-Identifier: MIT
// Silent preview of the world before the first click, interactive and in the page's own thread. It has a low sample rate, because
// only its picture and levels are displayed.
import { Player } from './player.js';

const rate = 6000, blockFrames = 16; // as many blocks a second as 128 frames at 48 kHz
const longestGap = 0.1; // s: a page that was hidden does not catch up
const busyMs = 20; // of a picture; a world that needs more goes slower, and the page stays usable

export class Preview {
    #player; #last = 0; #timer = 0; #owed = 0;
    constructor(compiled, outputs, onTold) { this.#player = new Player(compiled, rate, outputs, onTold); }

    get lists() { return this.#player.lists(); }
    tell(message) { this.#player.obey(message); }

    run() {
        const step = now => {
            this.#owed += rate * Math.min(longestGap, Math.max(0, now - this.#last) / 1000);
            this.#last = now;
            for (const began = performance.now(); this.#owed >= blockFrames && performance.now() - began < busyMs; this.#owed -= blockFrames) this.#player.render(blockFrames);
            this.#owed %= blockFrames;
            this.#timer = requestAnimationFrame(step);
        };
        this.#last = performance.now();
        this.#timer = requestAnimationFrame(step);
    }
    pause(isPaused) {
        this.end();
        if (!isPaused) this.run();
    }
    end() { cancelAnimationFrame(this.#timer); }
}
