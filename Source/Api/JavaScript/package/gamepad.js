// SPDX-License-Identifier: MIT
// Output to all game controllers of the browser, and a phone's own motor. The module sums the energy of all sounding events (as the native sink does), so a weak hit never
// ends a strong one and none is lost.
import { Clock, followed } from './clock.js';
import { PhysVibError } from './module.js';
import { Waves } from './waves.js';

const commandMs = 200; // one lasts as long, and is repeated before: motors stop soon if a page does
const nsPerMs = 1e6;
const seams = ['now', 'getGamepads', 'vibrate', 'setTimeout', 'clearTimeout', 'audioBuffer']; // of tests

/** Names of the effects that a controller supports. */
const effectsOf = ({ vibrationActuator: actuator }) => (actuator ? actuator.effects ?? (actuator.type ? [actuator.type] : ['dual-rumble']) : []);

/** Browsers permit a phone's motor only after the first touch, and warn before. */
function phoneMotor(navigator) {
    return navigator?.vibrate && (ms => navigator.userActivation?.hasBeenActive !== false && navigator.vibrate(ms));
}

class Pads {
    #waves; #motors; #latency; #timer = null; #ends = new Set(); #level; #now; #pads; #vibrate; #setTimer; #clearTimer; #last = { low: 0, high: 0 };
    #next = null; // what follows a command that was the strongest of several
    /** Commands sent so far, and those that a controller has refused. */
    commands = 0;
    refused = 0;

    constructor(physvib, { profile = 'pad-generic', latency, level = 1, fieldWidth = 1, fieldHeight = 1, phone = true, ...system }) {
        if (!physvib.pad) throw new PhysVibError(-2, 'rumble: expected the library (await load())');
        for (const name in system) if (!seams.includes(name)) throw new PhysVibError(-2, `${name}: expected one of profile, latency, level, fieldWidth, fieldHeight, phone`);
        if (!(level >= 0)) throw new PhysVibError(-2, `level: expected 0 or more, found ${level}`);
        this.#motors = physvib.pad(profile, { fieldWidth, fieldHeight });
        this.#waves = new Waves(physvib, { fieldWidth, fieldHeight }, system.audioBuffer);
        new Clock(latency); // refuses what is none
        this.#latency = latency;
        this.#level = level;
        this.#now = system.now ?? (() => performance.now());
        this.#pads = system.getGamepads ?? (() => globalThis.navigator?.getGamepads?.() ?? []);
        this.#vibrate = !phone ? undefined : system.vibrate ?? phoneMotor(globalThis.navigator);
        this.#setTimer = system.setTimeout ?? ((call, ms) => setTimeout(call, ms));
        this.#clearTimer = system.clearTimeout ?? (timer => clearTimeout(timer));
    }

    /** Plays the events of `haptics` (of attach) from now on; returns a function that ends it. */
    follow(haptics) {
        const end = followed(haptics, new Clock(this.#latency), () => this.#now() * nsPerMs, events => this.strike(events, 0));
        this.#ends.add(end);
        return () => {
            this.#ends.delete(end);
            end();
        };
    }

    /** Queues events, `laterNs` after their own times. */
    strike(events, laterNs = this.#now() * nsPerMs) {
        const felt = events.map(event => ({ ...event, timeNs: Math.max(0, event.timeNs + laterNs) }));
        for (const event of felt) this.#motors.strike(event);
        this.#waves.strike(felt);
        this.#waves.send([...this.#pads()], this.#now() * nsPerMs, this.#level);
        this.#wait();
    }

    get lost() { return this.#motors.lost; }
    setLevel(level) { this.#level = level; }
    /** Stops all motors at once. */
    stop() {
        this.#motors.stop(this.#now() * nsPerMs);
        this.#next = null;
        this.#waves.stop([...this.#pads()]);
        this.#send({ low: 0, high: 0 });
        this.#wait();
    }
    close() {
        for (const end of this.#ends) end();
        this.#ends.clear();
        this.#clearTimer(this.#timer);
        this.#send({ low: 0, high: 0 });
        this.#motors.free();
    }

    // Each command has a timer; none runs while the motors are at rest.
    #wait() {
        this.#clearTimer(this.#timer);
        const dueNs = Math.min(this.#motors.dueNs, this.#waves.dueNs, this.#next?.dueNs ?? Infinity);
        if (dueNs === Infinity) return;
        this.#timer = this.#setTimer(() => this.#act(), Math.max(0, Math.ceil(dueNs / nsPerMs - this.#now()))); // timers know whole milliseconds
    }
    #act() {
        const nowNs = this.#now() * nsPerMs;
        let peak = this.#next?.dueNs <= nowNs ? this.#next : null, last = peak;
        // A page that was busy sends the strongest of what is due, per motor: a hit that is over is felt, and then what followed it.
        for (let first = true; this.#motors.dueNs <= nowNs; first = false) {
            last = this.#motors.next(this.#level);
            peak = first ? last : { low: Math.max(peak.low, last.low), high: Math.max(peak.high, last.high) };
        }
        if (peak) {
            this.#send(peak);
            this.#next = peak.low > last.low || peak.high > last.high ? { ...last, dueNs: nowNs + 1e9 / this.#motors.commandsPerSecond } : null;
        }
        this.#waves.send([...this.#pads()], nowNs, this.#level);
        this.#wait();
    }

    #send({ low, high }) {
        ++this.commands;
        for (const pad of this.#pads()) if (pad?.connected !== false && pad?.vibrationActuator && !this.#waves.takes(pad)) this.#rumble(pad, low, high);
        this.#buzz(Math.max(low, high));
        this.#last = { low, high };
    }

    // Effects replace one another: triggers get what the grips get where a controller has motors there.
    #rumble(pad, low, high) {
        const effects = effectsOf(pad), triggers = effects.includes('trigger-rumble'), effect = triggers ? 'trigger-rumble' : 'dual-rumble', { vibrationActuator: actuator } = pad;
        if (low === 0 && high === 0 && actuator.reset) return this.#count(actuator.reset());
        this.#count(actuator.playEffect(effect, { startDelay: 0, duration: low === 0 && high === 0 ? 1 : commandMs, strongMagnitude: low, weakMagnitude: high,
            ...(triggers ? { leftTrigger: low / 2, rightTrigger: high / 2 } : {}) }));
    }
    #count(answer) { answer?.then?.(result => { if (result !== 'complete' && result !== 'preempted') ++this.refused; }, () => { ++this.refused; }); }

    // A phone's motor is on or off: the stronger, the longer within each interval; Android starts none for less than 10 ms.
    #buzz(strength) {
        if (!this.#vibrate || (strength === 0 && this.#last.low === 0 && this.#last.high === 0)) return;
        this.#vibrate(strength === 0 ? 0 : Math.max(10, Math.round(strength * 1000 / this.#motors.commandsPerSecond)));
    }
}

/** `options`: profile (a name, or a profile of Docs/pads.md), fieldWidth, fieldHeight (m), latency (s), level, phone: false. */
export function rumble(physvib, options = {}) { return new Pads(physvib, options); }
