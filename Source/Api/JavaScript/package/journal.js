// SPDX-License-Identifier: MIT
// Lists the motions and contacts of a step as numbers, in order, for one call; Step.cpp reads them. A step may have thousands, so nothing is allocated.
export const leftOut = -2e300; // a default
const mostOfEntry = 19;

/** Value of `point` in contactOf(): the points of a pair are told apart by place. */
export const byPlace = -2;
/** A contact, which World.touch describes, as numbers alone. Engines of JavaScript keep such members without allocating, as long as each is always a number. */
export const contactOf = () => ({ x: leftOut, y: leftOut, z: leftOut, normalX: leftOut, normalY: leftOut, normalZ: leftOut, impulse: leftOut, approach: leftOut, restitution: leftOut, fraction: leftOut, gap: leftOut, gapFraction: leftOut, alongA: leftOut, alongB: leftOut, soft: leftOut, point: 0 });

export class Journal {
    #numbers = new Float64Array(4096); #count = 0;

    #makeRoom(count) {
        while (this.#count + count > this.#numbers.length) {
            const larger = new Float64Array(2 * this.#numbers.length);
            larger.set(this.#numbers);
            this.#numbers = larger;
        }
    }
    // Starts an entry and returns the index of its first value; makes room for the largest entry.
    #begin(kind, id) {
        this.#makeRoom(mostOfEntry);
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
    /** Adds a contact; `c` is an object of contactOf(). */
    touch(a, b, c) {
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

    /** Number of values written so far; copy() returns those from `place` on, and again() writes such a copy. */
    get place() { return this.#count; }
    copy(place) { return this.#numbers.slice(place, this.#count); }
    again(copy) {
        this.#makeRoom(copy.length);
        this.#numbers.set(copy, this.#count);
        this.#count += copy.length;
    }

    /** Returns the numbers written since the last call, and empties the journal. */
    take() {
        const written = this.#numbers.subarray(0, this.#count);
        this.#count = 0;
        return written;
    }
}
