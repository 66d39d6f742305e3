// SPDX-License-Identifier: MIT
// Maps a world's time to another clock, by a line and a latency. A game that steps 1/60 s at each of 45 frames per second takes a third longer than its own time, and so
// does its haptic output. The line is learned in a second, and again when the game's pace changes or after a pause.
import { PhysVibError } from './module.js';

const nsPerMs = 1e6;
const frameNs = 15e3; // less than one of audio: by so much a picture may move a line that is learned
const firstLearningNs = 1000 * nsPerMs, learningNs = 700 * nsPerMs; // meanwhile each picture may move it
const mostLatencyNs = 250 * nsPerMs, reserveNs = 8 * nsPerMs, lessNs = 16 * nsPerMs;
const leastPictures = 5; // to fit a line, and to find that it is wrong
const suddenNs = 60 * nsPerMs; // from one picture to the next: the game stood still
const calmNs = 750 * nsPerMs; // a latency that is too large is made smaller after as long
const room = 160; // pictures: a second of 144 and more

export class Clock {
    #worlds = new Float64Array(room); #nows = new Float64Array(room); #olds = new Float64Array(room); #count = 0; #next = 0; // pictures, the last of them before #next
    #world = null; #now = 0; #rate = 1; // the line: at that time of the world, and how fast it goes
    #step = null; #old = 0; #lastNow = 0; // the world's time after the last step, and before this picture's first
    #learnsUntil = Infinity; #spread = 0; #wasSudden = false; #changed = 0; #patience = calmNs; #isFixed;
    /** How often the line was restarted or the latency changed, as after a pause or a change of pace. */
    moves = 0;

    /** `latency`: from a collision to its vibration, s; undefined: as little as the game's steps and pictures, and the page's clock, allow. */
    constructor(latency) {
        this.#isFixed = latency !== undefined;
        if (this.#isFixed && !(latency >= 0 && latency <= 10)) throw new RangeError(`latency: expected 0 to 10 s, found ${latency}`);
        this.latencyNs = this.#isFixed ? latency * 1e9 : 60e6; // until it is learned
    }

    /** To be called after each step, with the world's time and that of the other clock, ns. */
    align(worldNs, nowNs) {
        if (worldNs === this.#step) return;
        if (this.#step === null || worldNs < this.#step) this.#begin(worldNs, nowNs);
        else if (nowNs !== this.#lastNow) this.#end(nowNs);
        if (nowNs !== this.#lastNow) this.#old = this.#step ?? worldNs;
        [this.#step, this.#lastNow] = [worldNs, nowNs];
    }

    /** Time of the other clock, ns, at which an event of that world time is felt. */
    at(worldNs) { return this.#lineAt(worldNs) + this.latencyNs; }
    #lineAt(worldNs) { return this.#now + (worldNs - this.#world) * this.#rate; }

    #begin(worldNs, nowNs) {
        if (this.#step !== null) ++this.moves;
        [this.#world, this.#now, this.#rate, this.#count, this.#step] = [worldNs, nowNs, 1, 0, null];
        this.#learnsUntil = nowNs + firstLearningNs;
    }

    // A picture has ended. Its last step gives the game's time, since some games catch up in several steps.
    #end(nowNs) {
        const world = this.#step, now = this.#lastNow, error = now - this.#lineAt(world), last = (this.#next + room - 1) % room;
        const isSudden = this.#count > 0 && Math.abs(error - (this.#nows[last] - this.#lineAt(this.#worlds[last]))) > suddenNs;
        if (isSudden) {
            if (this.#wasSudden) this.#rate = (now - this.#nows[last]) / (world - this.#worlds[last]); // so it is the pace
            this.#learnAnew(now, 0);
            this.#old = world; // what was before is over
        }
        this.#wasSudden = isSudden;
        [this.#worlds[this.#next], this.#nows[this.#next], this.#olds[this.#next]] = [world, now, this.#old];
        this.#next = (this.#next + 1) % room;
        this.#count = Math.min(room, this.#count + 1);
        if (isSudden) [this.#world, this.#now] = [world, now];
        else if (nowNs < this.#learnsUntil) this.#learn();
        else this.#follow(world, now, error);
    }

    #learnAnew(nowNs, kept) {
        ++this.moves;
        this.#count = Math.min(this.#count, kept);
        this.#learnsUntil = Math.max(nowNs + learningNs, Math.min(this.#learnsUntil, nowNs + firstLearningNs));
    }

    #at(i) { return (this.#next - this.#count + i + 2 * room) % room; }

    // Fits the line to all pictures by least squares; a pace within 1% of one counts as one.
    #learn() {
        const n = this.#count, origin = this.#at(n - 1), world0 = this.#worlds[origin], now0 = this.#nows[origin];
        let world = 0, now = 0, least = Infinity, most = -Infinity;
        for (let i = 0; i < n; ++i) {
            const at = this.#at(i), start = this.#nows[at] - this.#worlds[at];
            world += (this.#worlds[at] - world0) / n;
            now += (this.#nows[at] - now0) / n;
            least = Math.min(least, start);
            most = Math.max(most, start);
        }
        let spread = 0, product = 0;
        for (let i = 0; i < n; ++i) {
            const at = this.#at(i), from = this.#worlds[at] - world0 - world;
            spread += from * from;
            product += from * (this.#nows[at] - now0 - now);
        }
        if (most - least < frameNs) [this.#world, this.#now, this.#rate] = [this.#worlds[this.#at(0)], this.#nows[this.#at(0)], 1];
        else {
            if (n >= leastPictures && spread > 0) this.#rate = product / spread;
            if (Math.abs(this.#rate - 1) < 0.01) this.#rate = 1;
            [this.#world, this.#now] = [world0 + world, now0 + now];
        }
        this.#spread = this.#spreadOf(n);
        if (!this.#isFixed && n >= leastPictures) this.latencyNs = this.#wanted(n);
        this.#changed = this.#lastNow;
    }

    // Spread of the last n pictures around the line, ns, or the resolution of the clock if that is larger.
    #spreadOf(n) {
        let least = Infinity, most = -Infinity, grain = Infinity, before = 0;
        for (let i = this.#count - n; i < this.#count; ++i) {
            const at = this.#at(i), error = this.#nows[at] - this.#lineAt(this.#worlds[at]);
            least = Math.min(least, error);
            most = Math.max(most, error);
            if (i === this.#count - n) continue;
            const passed = this.#nows[at] - this.#nows[this.#at(i - 1)], other = Math.abs(passed - before);
            if (other > 1e3) grain = Math.min(grain, i > this.#count - n + 1 ? other : passed);
            before = passed;
        }
        return Math.max(most - least, grain < 30 * nsPerMs ? grain : 0);
    }

    // An event has happened within the picture's steps; pictures come late, and clocks of pages stand still between blocks of audio.
    #wanted(n) {
        let most = 0;
        for (let i = this.#count - n; i < this.#count; ++i) most = Math.max(most, this.#neededAt(this.#at(i)));
        return Math.min(mostLatencyNs, most + this.#spreadOf(n) + reserveNs);
    }
    #neededAt(at) { return this.#nows[at] - this.#lineAt(this.#olds[at]); }

    #follow(world, now, error) {
        let least = Infinity, most = -Infinity, late = 0;
        for (let i = Math.max(0, this.#count - leastPictures); i < this.#count; ++i) {
            const at = this.#at(i), each = this.#nows[at] - this.#lineAt(this.#worlds[at]);
            least = Math.min(least, each);
            most = Math.max(most, each);
            if (this.#neededAt(at) > this.latencyNs - reserveNs) ++late;
        }
        const bound = this.#spread + reserveNs / 2;
        if (this.#count >= leastPictures && (least > bound || most < -bound)) {
            this.#learnAnew(now, leastPictures);
            this.#learn();
            return;
        }
        // The line moves by less than one can feel from picture to picture.
        const by = Math.abs(error) > frameNs ? Math.max(-frameNs, Math.min(frameNs, 0.02 * error)) : 0;
        [this.#now, this.#world] = [this.#lineAt(world) + by, world];
        if (by !== 0) this.#rate += Math.max(-1e-4, Math.min(1e-4, 2e-4 * error / (16 * nsPerMs)));
        if (!this.#isFixed) this.#suit(now, late);
    }

    // Adapts the latency to the game's pictures: raises it when three of five were late, and lowers it after a while without late ones, each time later.
    #suit(now, late) {
        if (late >= 3) {
            if (this.latencyNs >= mostLatencyNs) return;
            this.#patience = Math.min(16e9, 2 * this.#patience);
            this.latencyNs = Math.max(this.latencyNs, this.#wanted(Math.min(this.#count, leastPictures)));
        } else {
            const n = Math.min(this.#count, room - 1);
            if (now - this.#changed < this.#patience || this.#nows[this.#at(this.#count - 1)] - this.#nows[this.#at(this.#count - n)] < calmNs) return;
            const wanted = this.#wanted(n);
            if (wanted > this.latencyNs - lessNs) return;
            this.latencyNs = wanted;
        }
        this.#spread = this.#spreadOf(this.#count);
        ++this.moves;
        this.#changed = now;
    }
}

/** Calls `act(events)` for each step of `source`, an attachment, or of a world whose events are struck by hand; their times are `nowNs`'s, which is undefined while
 * that clock stands still: events of then are over, `missed(count)`. */
export function followed(source, clock, nowNs, act, missed) {
    if (typeof source?.follow !== 'function') throw new PhysVibError(-2, `follow: expected what attach returns, found ${source?.constructor?.name ?? source}`);
    return source.follow((events, world) => {
        const now = nowNs();
        if (now === undefined) return missed(events.length);
        clock.align(world.timeNs, now);
        if (events.length > 0) act(events.map(event => ({ ...event, timeNs: Math.max(0, clock.at(event.timeNs)) })));
    });
}
