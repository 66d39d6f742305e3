// SPDX-License-Identifier: MIT
// What an attachment observes in a step, in order, as a list of numbers that is told in one call; Step.cpp reads it.
const leftOut = -2e300, unknown = -1e300; // a default; PHYSVIB_UNKNOWN
const numberOf = value => (value === undefined ? leftOut : value === null ? unknown : value);
const points = { none: -1, place: -2 }, soft = { whole: 2 };

export class Journal {
    #numbers = new Float64Array(4096); #count = 0;

    #write(...values) {
        if (this.#count + values.length > this.#numbers.length) {
            const larger = new Float64Array(2 * this.#numbers.length);
            larger.set(this.#numbers);
            this.#numbers = larger;
        }
        for (let i = 0; i < values.length; ++i) this.#numbers[this.#count++] = values[i];
    }

    move(id, x, y, vx, vy, spin) { this.#write(0, id, x, y, vx, vy, spin); }
    moved(id, vx, vy, spin) { this.#write(1, id, vx, vy, spin); }
    /** A contact as World.touch takes it. */
    touch(a, b, c) {
        this.#write(2, a, b, numberOf(c.x), numberOf(c.y), numberOf(c.z), numberOf(c.normalX), numberOf(c.normalY), numberOf(c.normalZ), numberOf(c.impulse), numberOf(c.approach),
            numberOf(c.restitution), numberOf(c.fraction), numberOf(c.gap), numberOf(c.gapFraction), numberOf(c.alongA), numberOf(c.alongB), numberOf(soft[c.isSoft] ?? c.isSoft),
            numberOf(points[c.point] ?? c.point));
    }
    /** Vectors with x, y and z; `inertia`: as World.moveInSpace, or null. */
    moveInSpace(id, centre, v, spin, inertia) {
        this.#write(3, id, centre.x, centre.y, centre.z, v.x, v.y, v.z, spin.x, spin.y, spin.z, inertia ? 1 : 0);
        if (inertia) this.#write(...inertia);
    }
    movedInSpace(id, v, spin) { this.#write(4, id, v.x, v.y, v.z, spin.x, spin.y, spin.z); }

    /** What was written since; empties it. */
    take() {
        const written = this.#numbers.subarray(0, this.#count);
        this.#count = 0;
        return written;
    }
}
