// SPDX-License-Identifier: MIT
// Base of attachments to 3D engines that report who touches where, but no usable impulses: impacts follow from speeds and restitution, lasting contacts from momentum.
// Subclasses say how bodies and contacts are read.
import { Haptics, meet } from './haptics.js';
import { byPlace, contactOf, leftOut } from './journal.js';
import { dot, lostAt, nowhere, plus, sizeOf, spotAt, stopBefore, stopBehind } from './space.js';
import { closingOf } from './stops.js';

/** World.moveInSpace's inverse of moments of inertia about three axes. */
export function inverseOf(moments, axes) {
    const sum = [0, 0, 0, 0, 0, 0];
    for (const [i, { x, y, z }] of axes.entries()) if (moments[i] > 0) for (const [j, part] of [x * x, y * y, z * z, x * y, x * z, y * z].entries()) sum[j] += part / moments[i];
    return sum;
}

export class SpaceHaptics extends Haptics {
    #seconds = 0; #lastSeconds = 0; #pull = nowhere; #now = { at: nowhere, v: nowhere, turns: nowhere, inverse: null, isRound: false, isAsleep: false }; #spot = Object.assign(contactOf(), { soft: 1 });

    /** `engine`: besides what Haptics asks, bodies(); read(body, to), which writes at (centre of mass), v, turns, inverse (as World.moveInSpace), isAsleep;
     * advance(seconds); contacts(tell, placeOf), which calls tell of each point, and may ask where a body was before; gravity(). Lengths are the engine's. `isSoft`: it takes more than a step for a blow; `subSteps`:
     * it moves by such shares of a step; `looksAhead`: it tells of what will not touch in the step;
     * `tellsImpulses`: of contacts that last; velocities behind the step are not asked. */
    constructor(physvib, engine, options) {
        super(physvib, { keyOf: body => body, look: () => ({ filters: [] }), isSoft: true, subSteps: 1, ...engine }, options);
        this.#spot.soft = this.engine.isSoft ? 1 : leftOut;
    }

    /** To be called before and after a step of the engine, if another program steps it. */
    before(seconds) { this.guarded(() => this.#before(seconds)); }
    after(isDone = true) { this.finish(isDone ? () => this.#after() : undefined); }
    /** Who steps the engine is seen; `advance` does it, or engine.advance. */
    step(seconds, advance = () => this.engine.advance(seconds)) { advance(seconds); }
    update(seconds) { this.step(seconds); }

    #read(body) {
        const now = this.#now, unit = this.metresPerUnit;
        now.isAsleep = false;
        this.engine.read(body, now);
        now.at = plus(nowhere, now.at, unit);
        now.v = plus(nowhere, now.v, unit);
        now.turns = plus(nowhere, now.turns); // engines change theirs
        return now;
    }
    #before(seconds) {
        const unit = this.metresPerUnit;
        this.#seconds = seconds;
        this.#pull = plus(nowhere, this.engine.gravity(), unit);
        for (const body of this.engine.bodies()) this.know(body); // what it will touch, too
        this.begin(seconds, sizeOf(this.#pull));
        for (const known of this.each()) {
            const { at, v, turns, inverse, isRound, isAsleep } = this.#read(known.body);
            Object.assign(known, { at, v, turns, isRound, falls: known.isStatic || isAsleep ? 0 : known.gravityScale });
            const free = plus(v, this.#pull, known.falls * seconds);
            if (!this.engine.tellsImpulses) stopBefore(known, free);
            this.journal.moveInSpace(known.id, at, free, turns, known.isStatic || !inverse ? null : inverse.map(part => part / (unit * unit)));
        }
    }
    #after() {
        const moving = [];
        for (const known of this.eachThere()) {
            if (!known.at || this.engine.tellsImpulses) continue;
            const { at, v, turns } = this.#read(known.body);
            if (known.isStatic) { // what is moved by its place has its speed within the step
                known.v = v;
                known.turns = turns;
                continue;
            }
            this.journal.movedInSpace(known.id, v, turns);
            moving.push([known, at, v]);
        }
        this.engine.contacts(this.#tell, this.#placeOf);
        for (const [{ stop }, at, v] of moving) stopBehind(stop, at, v, this.#seconds, this.#seconds / this.engine.subSteps); // for the next step's contacts
        this.#lastSeconds = this.#seconds;
    }

    #placeOf = body => plus(nowhere, this.known(body)?.at ?? nowhere, 1 / this.metresPerUnit);
    // `gap`: when the engine looked, before it moved anything; it bounces at `least` (m/s) and more; `impulse`: of a contact that lasts, if it is known.
    #tell = (bodyA, bodyB, at, normal, gap, restitution, least = 0, impulse = leftOut) => {
        const a = this.known(bodyA), b = this.known(bodyB), unit = this.metresPerUnit, spot = this.#spot, seconds = this.#seconds;
        if (!a?.at || !b?.at || a === b || (a.isStatic && b.isStatic)) return;
        spotAt(a, b, plus(nowhere, at, unit), normal, spot);
        const pull = (a.falls - b.falls) * dot(this.#pull, normal), isPut = a.stop?.isPut || b.stop?.isPut, { approach: speed } = spot;
        spot.gap = gap * unit;
        if (this.engine.looksAhead && spot.gap > Math.max(0, speed + pull * seconds) * seconds + 1e-6) return; // near, and not yet there
        const short = spot.gap + (isPut ? 0 : Math.min(0, lostAt(b, spot) - lostAt(a, spot)));
        meet(spot, pull, seconds);
        if (short < 0 ? speed > 0 : spot.fraction !== leftOut) {
            spot.fraction = isPut && short < 0 ? 0 : closingOf(short, speed, pull, seconds, this.#lastSeconds, seconds / this.engine.subSteps);
            spot.gap = leftOut;
        }
        spot.restitution = spot.approach < least * unit ? 0 : Math.min(1, Math.max(0, restitution));
        spot.impulse = impulse;
        spot.point = a.isRound || b.isRound ? 0 : byPlace;
        this.journal.touch(a.id, b.id, spot);
    };
}
