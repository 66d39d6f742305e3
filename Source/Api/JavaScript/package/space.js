// SPDX-License-Identifier: MIT
// Engines in space that tell who touches where, and no impulses that could be used: what a blow is follows from speeds and restitution, what lasts from momentum. Their
// adapters say how bodies and contacts are read.
import { Haptics, meet } from './haptics.js';
import { contactOf, leftOut } from './journal.js';
import { closingOf, startOf, stopOf, endOf } from './stops.js';

export const plus = (a, b, times = 1) => ({ x: a.x + times * b.x, y: a.y + times * b.y, z: a.z + times * b.z });
export const dot = (a, b) => a.x * b.x + a.y * b.y + a.z * b.z;
export const cross = (a, b) => ({ x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x });
export const nowhere = { x: 0, y: 0, z: 0 };
/** A point turned by a quaternion. */
export const turn = (q, p) => {
    const t = cross(q, p);
    return plus(plus(p, t, 2 * q.w), cross(q, t), 2);
};
const sizeOf = v => Math.sqrt(dot(v, v));

/** World.moveInSpace's inverse of moments of inertia about three axes. */
export function inverseOf(moments, axes) {
    const sum = [0, 0, 0, 0, 0, 0];
    for (const [i, { x, y, z }] of axes.entries()) if (moments[i] > 0) for (const [j, part] of [x * x, y * y, z * z, x * y, x * z, y * z].entries()) sum[j] += part / moments[i];
    return sum;
}

/** Into `spot`: where two known bodies touch (metres), the normal from a to b, how fast that closes, and how it runs along both surfaces. */
export function spotAt(a, b, at, n, spot) {
    const va = plus(a.v, cross(a.turns, plus(at, a.at, -1))), vb = plus(b.v, cross(b.turns, plus(at, b.at, -1)));
    const point = b.isRound ? b.v : a.isRound ? a.v : b.isStatic ? va : vb; // goes with a round body's centre, or with the corner of what moves
    const across = v => plus(v, n, -dot(v, n)), ua = across(plus(point, va, -1)), ub = across(plus(point, vb, -1));
    const along = sizeOf(ua) > sizeOf(ub) ? ua : ub, length = sizeOf(along) || 1; // in which grains are passed
    spot.x = at.x;
    spot.y = at.y;
    spot.z = at.z;
    spot.normalX = n.x;
    spot.normalY = n.y;
    spot.normalZ = n.z;
    spot.approach = dot(plus(va, vb, -1), n);
    spot.alongA = dot(ua, along) / length;
    spot.alongB = dot(ub, along) / length;
}
/** What a body's stop has lost of its way along the contact's normal. */
export const lostAt = ({ stop, at, turns }, { x, y, z, normalX, normalY, normalZ }) =>
    (stop ? dot(plus({ x: stop.toX, y: stop.toY, z: stop.toZ }, cross(turns, plus({ x, y, z }, at, -1)), stop.turn), { x: normalX, y: normalY, z: normalZ }) : 0);
/** Of a body that is known, with `free`, its velocity as gravity makes it. */
export function stopBefore(known, free) {
    const { at, v } = known;
    if (!known.isStatic) startOf(known.stop ??= stopOf(), at.x, at.y, at.z, v.x, v.y, v.z, free.x, free.y, free.z);
}
export const stopBehind = (stop, at, v, seconds, subSeconds) => endOf(stop, at.x, at.y, at.z, v.x, v.y, v.z, seconds, subSeconds);

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

    /** Before a step of the engine, and behind it: for who lets another step it. */
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
        spot.point = a.isRound || b.isRound ? 0 : -2;
        this.journal.touch(a.id, b.id, spot);
    };
}
