// SPDX-License-Identifier: MIT
// Converts events to commands of the two motors of a game controller, with the module's arithmetic and the profiles of the native sink.
import { PhysVibError } from './module.js';
import { profiles } from './profiles.js';

const motor = ({ threshold, half, full, rise_s: rise, fall_s: fall }) => [threshold, half, full, rise, fall];

function numbersOf(profile) {
    const law = typeof profile === 'string' ? profiles[profile] : profile;
    if (!law?.low || !law.high) throw new PhysVibError(-2, `pad: expected ${Object.keys(profiles).join(', ')} or a profile with low and high, found ${String(profile)}`);
    return Float64Array.from([...motor(law.low), ...motor(law.high), law.commands_per_s, law.lead_s, law.split_hz, law.side, law.floor, law.exponent]);
}

export class Pad {
    #module; #pad; #forget;

    constructor(module, registry, profile = 'pad-generic', { fieldWidth = 1, fieldHeight = 1 } = {}) {
        this.#module = module;
        const at = this.#pad = module.withBytes(new Uint8Array(numbersOf(profile).buffer), law => module.run('js_pad_create', law, fieldWidth, fieldHeight) || module.refuse());
        this.#forget = registry(this, () => module.run('js_pad_free', at));
    }

    /** Queues an event, whose time is that at which it is felt. */
    strike(event) { this.#module.withEvents([event], at => this.#module.check('js_pad_strike', this.#pad, at)); }
    /** When the next command is due, in ns of the events' time; Infinity: the motors are at rest. */
    get dueNs() { return this.#module.run('js_pad_due', this.#pad); }
    /** The command that is due: { timeNs, low, high }, of the heavy and the light motor, 0 to 1. */
    next(level = 1) {
        const [timeNs, low, high] = this.#module.doubles(this.#module.run('js_pad_next', this.#pad, level), 3);
        return { timeNs, low, high };
    }
    stop(atNs) { this.#module.run('js_pad_stop', this.#pad, atNs); }
    get lost() { return this.#module.run('js_pad_lost', this.#pad); }
    get commandsPerSecond() { return this.#module.run('js_pad_commands_per_second', this.#pad); }
    free() { this.#forget(); }
}
