// SPDX-License-Identifier: MIT
// Vibration of game controllers and phones, with the package's own module. All sounding modes are summed, so no impact is lost while another sounds.
import { rumble } from './gamepad.js';
import { Pad } from './pad.js';
import { eventOf } from './record.js';
import { firstLevel } from './sound.js';

export class Pads {
    #module; #pads = null; #followers = new Set(); #level = 1;
    constructor(module) { this.#module = module; }

    get isOn() { return this.#pads !== null; }
    /// Switches vibration on for a field of that size (m), or off.
    set(isOn, [fieldWidth, fieldHeight]) {
        this.#pads?.close();
        this.#pads = null;
        if (!isOn) return;
        const pad = (profile, field) => new Pad(this.#module, (object, free) => free, profile, field);
        this.#pads = rumble({ pad }, { fieldWidth, fieldHeight });
        this.#pads.setLevel(this.#level);
        this.#pads.follow({ follow: follower => { this.#followers.add(follower); return () => this.#followers.delete(follower); } });
    }
    /// Sets the gain of the page. At its initial level, motors have the strength that the scene specifies.
    setLevel(gain) {
        this.#level = gain / firstLevel;
        this.#pads?.setLevel(this.#level);
    }
    /// Plays the impacts of a report of the player.
    play(hits, seconds) {
        if (!this.#pads) return;
        const events = hits.map(hit => eventOf(hit));
        for (const follower of this.#followers) follower(events, { timeNs: seconds * 1e9 });
    }
    stop() { this.#pads?.stop(); }
}
