// SPDX-License-Identifier: MIT
// Output to WebXR controllers, which navigator.getGamepads() does not have: pulses, with the arithmetic of motors, on the hand that made the hit.
import { expectThat } from './explanation.js';
import { rumble } from './gamepad.js';

const both = ['left', 'right'], coil = { threshold: 0, half: 0.5, full: 1, rise_s: 0.02, fall_s: 0.02 };
// One actuator a hand, which needs no push to begin; assumed, as no figures of such are known.
const profile = { low: coil, high: coil, commands_per_s: 60, lead_s: 0, split_hz: 100, side: 0, floor: 0.01, exponent: 0.7 };

/** A hand's actuators as a controller with two motors, of which the stronger counts. */
function padOf(actuators) {
    const pulse = (value, ms) => Promise.all(actuators.map(actuator => actuator.pulse(value, ms))).then(() => 'complete');
    return { vibrationActuator: { effects: ['dual-rumble'], playEffect: (_, { duration, strongMagnitude, weakMagnitude }) => pulse(Math.max(strongMagnitude, weakMagnitude), duration), reset: () => pulse(0, 1) } };
}

class Hands {
    #pads; #session;
    constructor(physvib, session, options) {
        this.#session = typeof session === 'function' ? session : () => session;
        this.#pads = Object.fromEntries(both.map(hand => [hand, rumble(physvib, { profile, ...options, phone: false, getGamepads: () => this.#held(hand) })]));
    }
    #held(hand) {
        const held = [...this.#session()?.inputSources ?? []].filter(({ handedness }) => handedness === hand);
        return held.flatMap(({ gamepad }) => (gamepad?.hapticActuators?.length ? [padOf([...gamepad.hapticActuators])] : []));
    }
    /** What `haptics` (of attach, or of feel) feels from now on: what touches a body of `left` on the left hand, of `right` on the right; without both, all on both. What it returns ends that. */
    follow(haptics, of = {}) {
        for (const name in of) expectThat(both.includes(name), 'follow', 'left, right', name);
        const isAll = Object.keys(of).length === 0, ends = both.map(hand => {
            const ids = new Set([of[hand] ?? []].flat().map(body => haptics.id(body))), isOf = ({ fixture, other }) => isAll || ids.has(fixture) || ids.has(other);
            return this.#pads[hand].follow({ follow: act => haptics.follow((events, world) => act(events.filter(isOf), world)) });
        });
        return () => { for (const end of ends) end(); };
    }
    /** Events, on a hand. */
    strike(hand, events, laterNs) { this.#pads[hand].strike(events, laterNs); }
    setLevel(level) { for (const hand of both) this.#pads[hand].setLevel(level); }
    /** Everything stands still, now. */
    stop() { for (const hand of both) this.#pads[hand].stop(); }
    close() { for (const hand of both) this.#pads[hand].close(); }
}

/** `session`: an XRSession, or a function that gives the one of now, or null. `options`: as rumble's. */
export function hands(physvib, session, options = {}) { return new Hands(physvib, session, options); }
