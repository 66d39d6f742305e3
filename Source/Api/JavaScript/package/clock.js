// SPDX-License-Identifier: MIT
// When a world's time is felt: its start on another clock, which stays as long as the world keeps pace.

export class Clock {
    #startNs = null;
    /** How often the start has moved: a game that stood still, or was too slow for long. */
    moves = 0;

    /** `slackNs`: frames of a game come early and late by less. */
    constructor(slackNs) { this.slackNs = slackNs; }

    /** The time of the other clock at the world's time 0; after a step: the world's time and the other's. */
    align(worldNs, nowNs) {
        const startNs = nowNs - worldNs;
        if (this.#startNs !== null && Math.abs(startNs - this.#startNs) <= this.slackNs) return this.#startNs;
        if (this.#startNs !== null) ++this.moves;
        return this.#startNs = startNs;
    }
}

/** Calls `act(events, startNs)` for each step of `source`, an attachment, or of a world whose events are struck by hand. */
export function followed(source, clock, nowNs, act) {
    if (typeof source?.follow !== 'function') throw new TypeError('follow: expected what attach returns');
    return source.follow((events, world) => {
        const startNs = clock.align(world.timeNs, nowNs());
        if (events.length > 0) act(events, startNs);
    });
}
