// SPDX-License-Identifier: MIT
// Controllers and the phone's motor, by the package's own module: all that rings is summed, so no hit is left out because another sounds.
import { rumble } from './gamepad.js';
import { Pad } from './pad.js';
import { eventOf } from './record.js';
import { firstLevel } from './sound.js';

export class Pads {
    #module; #pads = null; #followers = new Set(); #level = 1;
    constructor(module) { this.#module = module; }

    get isOn() { return this.#pads !== null; }
    /// On over a field of that size (m), or off.
    set(isOn, [fieldWidth, fieldHeight]) {
        this.#pads?.close();
        this.#pads = null;
        if (!isOn) return;
        const pad = (profile, field) => new Pad(this.#module, (object, free) => free, profile, field);
        this.#pads = rumble({ pad }, { fieldWidth, fieldHeight });
        this.#pads.setLevel(this.#level);
        this.#pads.follow({ follow: follower => { this.#followers.add(follower); return () => this.#followers.delete(follower); } });
    }
    /// The page's gain: at the level that it begins with, motors are as strong as the scene asks for.
    setLevel(gain) {
        this.#level = gain / firstLevel;
        this.#pads?.setLevel(this.#level);
    }
    /// What a report of the player has.
    play(hits, seconds) {
        if (!this.#pads) return;
        const events = hits.map(hit => eventOf(hit));
        for (const follower of this.#followers) follower(events, { timeNs: seconds * 1e9 });
    }
    stop() { this.#pads?.stop(); }
}
