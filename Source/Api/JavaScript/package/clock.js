// SPDX-License-Identifier: MIT
// When a world's time is felt: a line from its time to another clock's. It keeps its slope: a game that steps 1/60 s at each of 45 pictures a second lasts a third
// longer than its own time, and so does what is felt of it.
const nsPerMs = 1e6;
const learningNs = 1000 * nsPerMs; // until then each step may move the line; later by no more than a frame of audio
const frameNs = 15e3; // less than one
const usualLatencyNs = 60 * nsPerMs, mostLatencyNs = 250 * nsPerMs, reserveNs = 8 * nsPerMs;
const leastToFit = 8;

/** The line through points { world, now } that is nearest to all: its rate, and the other clock's time at the last point; and how far points lie beside it. */
function fitted(points) {
    const { length: n } = points, last = points[n - 1];
    const mean = name => points.reduce((sum, point) => sum + point[name] - last[name], 0) / n, world = mean('world'), now = mean('now');
    const product = (a, b) => points.reduce((sum, point) => sum + (point[a] - last[a] - (a === 'world' ? world : now)) * (point[b] - last[b] - (b === 'world' ? world : now)), 0);
    const spread = product('world', 'world'), rate = n >= leastToFit && spread > 0 ? product('world', 'now') / spread : 1, offset = now - rate * world;
    const beside = points.map(point => point.now - last.now - offset - rate * (point.world - last.world));
    return { rate, now: last.now + offset, early: -Math.min(...beside), late: Math.max(...beside) };
}

export class Clock {
    #points = []; #world = null; #now = 0; #rate = 1; #since = 0; #isFixed;
    /** How often the line was begun anew: a game that stood still, or whose pace changed. */
    moves = 0;

    /** `latency`: from a collision to its vibration, s; undefined: 0.06, or more if the game's steps or its pictures want it. */
    constructor(latency) {
        this.#isFixed = latency !== undefined;
        this.latencyNs = this.#isFixed ? latency * 1e9 : usualLatencyNs;
    }

    /** After a step: the world's time and the other's. */
    align(worldNs, nowNs) {
        if (this.#world !== null && worldNs === this.#world) return;
        const expected = this.#now + (worldNs - this.#world) * this.#rate, error = nowNs - expected;
        if (this.#world === null || worldNs < this.#world || Math.abs(error) > (nowNs - this.#since < learningNs ? learningNs / 2 : this.latencyNs)) {
            if (this.#world !== null) ++this.moves;
            this.#points = [];
            this.#since = nowNs;
        }
        const step = worldNs - this.#world;
        this.#world = worldNs;
        if (nowNs - this.#since < learningNs) this.#learn(nowNs);
        else {
            this.#points = [];
            this.#now = expected + (Math.abs(error) > frameNs ? Math.max(-frameNs, Math.min(frameNs, 0.02 * error)) : 0);
            this.#rate += Math.abs(error) > frameNs ? Math.max(-1e-4, Math.min(1e-4, 2e-4 * error / step)) : 0;
        }
    }
    #learn(nowNs) {
        this.#points.push({ world: this.#world, now: nowNs });
        const [first] = this.#points, { length } = this.#points, starts = this.#points.map(({ world, now }) => now - world), beside = Math.max(...starts) - Math.min(...starts);
        const keepsPace = beside < frameNs, { rate, now, early, late } = keepsPace ? { rate: 1, now: first.now - first.world + this.#world, early: 0, late: beside } : fitted(this.#points);
        const step = length > 1 ? rate * (this.#world - first.world) / (length - 1) : 0;
        [this.#rate, this.#now] = [rate, now];
        // Events are final a step after they happened; pictures come late, and clocks of pages stand still between blocks of audio.
        if (!this.#isFixed && length >= leastToFit) this.latencyNs = Math.max(this.latencyNs, Math.min(mostLatencyNs, 2 * step + 2 * late + early + reserveNs));
    }

    /** When what happened at that time of the world is felt. */
    at(worldNs) { return this.#now + (worldNs - this.#world) * this.#rate + this.latencyNs; }
}

/** Calls `act(events)` for each step of `source`, an attachment, or of a world whose events are struck by hand; their times are `nowNs`'s, which is undefined while
 * that clock stands still. */
export function followed(source, clock, nowNs, act) {
    if (typeof source?.follow !== 'function') throw new TypeError('follow: expected what attach returns');
    return source.follow((events, world) => {
        const now = nowNs();
        if (now === undefined) return;
        clock.align(world.timeNs, now);
        if (events.length > 0) act(events.map(event => ({ ...event, timeNs: Math.max(0, clock.at(event.timeNs)) })));
    });
}
