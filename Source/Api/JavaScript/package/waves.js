// SPDX-License-Identifier: MIT
// Output to controllers that play samples: playPCM(AudioBuffer) of the draft https://github.com/immersive-web/gamepad-haptics. A buffer replaces the one before, so each
// contains all that sounds and is scheduled from now on.
const rate = 8000; // Hz: of an AudioBuffer the least that every browser has; vibration is below 1 kHz
const aheadSeconds = 1; // of a buffer; what rings longer goes on with the next
const ringsSeconds = 3; // an event is forgotten then
const mostEvents = 256;
const restNs = 1e9 / 30; // between two buffers

export class Waves {
    #physvib; #settings; #makeBuffer; #events = []; #nextNs = 0; #isWaiting = false; #refused = new WeakSet();

    constructor(physvib, field, makeBuffer = options => new AudioBuffer(options)) {
        this.#physvib = physvib;
        this.#settings = { ...field, layout: 'phone1', rate };
        this.#makeBuffer = makeBuffer;
    }

    /** True if this controller gets samples instead of motor commands. */
    takes({ vibrationActuator: actuator }) { return typeof actuator?.playPCM === 'function' && typeof this.#physvib.render === 'function' && !this.#refused.has(actuator); }

    /** When the next buffer is due, in ns of the events' times. */
    get dueNs() { return this.#isWaiting ? this.#nextNs : Infinity; }

    /** Events at the times at which they are to be felt; what comes within a 30th of a second goes out together. */
    strike(events) {
        this.#events.push(...events);
        this.#isWaiting ||= events.length > 0;
    }

    /** Sends the waiting events to the controllers if the next buffer is due. */
    send(pads, nowNs, level) {
        if (nowNs < this.dueNs) return;
        this.#isWaiting = false;
        this.#events = this.#events.filter(event => event.timeNs + ringsSeconds * 1e9 > nowNs).sort((a, b) => a.timeNs - b.timeNs).slice(-mostEvents);
        const heard = pads.filter(pad => pad && pad.connected !== false && this.takes(pad));
        if (this.#events.length === 0 || heard.length === 0) return;
        this.#nextNs = nowNs + restNs;
        const fromNs = Math.min(nowNs, this.#events[0].timeNs), skip = Math.round((nowNs - fromNs) * 1e-9 * rate);
        const [samples] = this.#physvib.render(this.#events.map(event => ({ ...event, timeNs: event.timeNs - fromNs })), { ...this.#settings, seconds: skip / rate + aheadSeconds });
        for (const pad of heard) this.#play(pad, samples.subarray(skip).map(sample => sample * level));
    }

    stop(pads) {
        this.#events.length = 0;
        this.#isWaiting = false;
        for (const pad of pads) if (pad && this.takes(pad)) this.#play(pad, new Float32Array(1)); // an empty one would change nothing
    }

    // A controller that turns out to play no samples is driven by its motors from then on.
    #play({ vibrationActuator: actuator }, samples) {
        const sound = this.#makeBuffer({ numberOfChannels: 1, length: samples.length, sampleRate: rate });
        sound.copyToChannel(samples, 0);
        actuator.playPCM(sound).then(isPlayed => { if (isPlayed === false) this.#refused.add(actuator); }, () => this.#refused.add(actuator));
    }
}
