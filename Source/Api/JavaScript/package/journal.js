// SPDX-License-Identifier: MIT
// What an attachment observes in a step, in order, as a list of numbers that is told in one call; Step.cpp reads it. Thousands a step are usual, so nothing is allocated.
export const leftOut = -2e300, unknown = -1e300; // a default; PHYSVIB_UNKNOWN
const numberOf = value => (value === undefined ? leftOut : value === null ? unknown : value);
const pointOf = point => (point === 'place' ? -2 : point === 'none' ? -1 : numberOf(point));
const mostOfEntry = 19;

export const byPlace = -2;
/** A contact of numbers in a plane, which touchAt takes. Engines keep such members without allocating, as long as each is always a number. */
export const contactOf = () => ({ x: 0.5, y: 0.5, z: leftOut, normalX: 0.5, normalY: 0.5, normalZ: leftOut, impulse: 0.5, approach: 0.5, restitution: 0.5, fraction: leftOut, gap: 0.5, gapFraction: leftOut, alongA: 0.5, alongB: 0.5, soft: 0.5, point: 0 });

export class Journal {
    #numbers = new Float64Array(4096); #count = 0;

    // The place of an entry of that kind; there is room for the largest.
    #begin(kind, id) {
        if (this.#count + mostOfEntry > this.#numbers.length) {
            const larger = new Float64Array(2 * this.#numbers.length);
            larger.set(this.#numbers);
            this.#numbers = larger;
        }
        const at = this.#count, numbers = this.#numbers;
        numbers[at] = kind;
        numbers[at + 1] = id;
        return at + 2;
    }

    move(id, x, y, vx, vy, spin) {
        const at = this.#begin(0, id), numbers = this.#numbers;
        numbers[at] = x;
        numbers[at + 1] = y;
        numbers[at + 2] = vx;
        numbers[at + 3] = vy;
        numbers[at + 4] = spin;
        this.#count = at + 5;
    }
    moved(id, vx, vy, spin) {
        const at = this.#begin(1, id), numbers = this.#numbers;
        numbers[at] = vx;
        numbers[at + 1] = vy;
        numbers[at + 2] = spin;
        this.#count = at + 3;
    }
    /** A contact as World.touch takes it. */
    touch(a, b, c) {
        const { isSoft } = c;
        this.touchAt(a, b, { x: numberOf(c.x), y: numberOf(c.y), z: numberOf(c.z), normalX: numberOf(c.normalX), normalY: numberOf(c.normalY), normalZ: numberOf(c.normalZ), impulse: numberOf(c.impulse),
            approach: numberOf(c.approach), restitution: numberOf(c.restitution), fraction: numberOf(c.fraction), gap: numberOf(c.gap), gapFraction: numberOf(c.gapFraction), alongA: numberOf(c.alongA),
            alongB: numberOf(c.alongB), soft: isSoft === 'whole' ? 2 : isSoft === undefined ? leftOut : Number(isSoft), point: pointOf(c.point) });
    }
    /** The same of contactOf(). */
    touchAt(a, b, c) {
        const at = this.#begin(2, a), numbers = this.#numbers;
        numbers[at] = b;
        numbers[at + 1] = c.x;
        numbers[at + 2] = c.y;
        numbers[at + 3] = c.z;
        numbers[at + 4] = c.normalX;
        numbers[at + 5] = c.normalY;
        numbers[at + 6] = c.normalZ;
        numbers[at + 7] = c.impulse;
        numbers[at + 8] = c.approach;
        numbers[at + 9] = c.restitution;
        numbers[at + 10] = c.fraction;
        numbers[at + 11] = c.gap;
        numbers[at + 12] = c.gapFraction;
        numbers[at + 13] = c.alongA;
        numbers[at + 14] = c.alongB;
        numbers[at + 15] = c.soft;
        numbers[at + 16] = c.point;
        this.#count = at + 17;
    }
    #vector(at, { x, y, z }) {
        const numbers = this.#numbers;
        numbers[at] = x;
        numbers[at + 1] = y;
        numbers[at + 2] = z;
        return at + 3;
    }
    /** Vectors with x, y and z; `inertia`: as World.moveInSpace, or null. */
    moveInSpace(id, centre, v, spin, inertia) {
        let at = this.#vector(this.#vector(this.#vector(this.#begin(3, id), centre), v), spin);
        this.#numbers[at++] = inertia ? 1 : 0;
        if (inertia) for (let i = 0; i < 6; ++i) this.#numbers[at++] = inertia[i];
        this.#count = at;
    }
    movedInSpace(id, v, spin) { this.#count = this.#vector(this.#vector(this.#begin(4, id), v), spin); }

    /** How much was written so far; copies of what was written from there on, and such a copy again. */
    get place() { return this.#count; }
    copy(place) { return this.#numbers.slice(place, this.#count); }
    again(copy) {
        while (this.#count + copy.length > this.#numbers.length) {
            const larger = new Float64Array(2 * this.#numbers.length);
            larger.set(this.#numbers);
            this.#numbers = larger;
        }
        this.#numbers.set(copy, this.#count);
        this.#count += copy.length;
    }

    /** What was written since; empties it. */
    take() {
        const written = this.#numbers.subarray(0, this.#count);
        this.#count = 0;
        return written;
    }
}
