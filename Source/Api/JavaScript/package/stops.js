// SPDX-License-Identifier: MIT
// Continuous collision stops a body where it first touches, with the velocity of the step's end; it collides in the next step. What the step would have moved it on is
// lost, unless contacts may have taken it, or the game has put it elsewhere since. See physvib_box2d3.h.
const slop = 0.005; // m; and the share of its path that a body may be short of

/** Of a body: where it was, what it would have without contacts, and what it lost. Lengths are metres; in a plane, z is 0. */
export const stopOf = () => ({ x: 0.5, y: 0.5, z: 0.5, vx: 0.5, vy: 0.5, vz: 0.5, freeX: 0.5, freeY: 0.5, freeZ: 0.5, toX: 0.5, toY: 0.5, toZ: 0.5, turn: 0.5, isPut: true });

function keep(stop, x, y, z, vx, vy, vz) {
    stop.x = x;
    stop.y = y;
    stop.z = z;
    stop.vx = vx;
    stop.vy = vy;
    stop.vz = vz;
}
/** To be called before a step, with the velocity after gravity. */
export function startOf(stop, x, y, z, vx, vy, vz, freeX, freeY, freeZ) {
    stop.isPut = !(stop.x === x && stop.y === y && stop.z === z);
    if (stop.isPut || !(stop.vx === vx && stop.vy === vy && stop.vz === vz)) stop.toX = stop.toY = stop.toZ = stop.turn = 0;
    keep(stop, x, y, z, vx, vy, vz);
    stop.freeX = freeX;
    stop.freeY = freeY;
    stop.freeZ = freeZ;
}
/** Behind it, in which it has moved by steps of `subSeconds`: velocities change before bodies move. */
export function endOf(stop, x, y, z, vx, vy, vz, seconds, subSeconds) {
    const late = 0.5 * (seconds - subSeconds), toX = seconds * vx - late * (vx - stop.vx), toY = seconds * vy - late * (vy - stop.vy), toZ = seconds * vz - late * (vz - stop.vz);
    const path = Math.sqrt(toX * toX + toY * toY + toZ * toZ), pushed = 0.5 * seconds * Math.sqrt((vx - stop.freeX) ** 2 + (vy - stop.freeY) ** 2 + (vz - stop.freeZ) ** 2), rounding = 1e-6 * (Math.abs(x) + Math.abs(y) + Math.abs(z));
    const lost = path > 0 ? path - ((x - stop.x) * toX + (y - stop.y) * toY + (z - stop.z) * toZ) / path : 0, share = path < slop || lost > path || lost < slop * path + pushed + rounding ? 0 : lost / path;
    stop.toX = share * toX;
    stop.toY = share * toY;
    stop.toZ = share * toZ;
    stop.turn = share * seconds;
    keep(stop, x, y, z, vx, vy, vz);
}

/** When a gap closes, in steps of `seconds` after the start of this one; below 0: it has in the one before, of `lastSeconds`. Of a body that is faster by half a small step's gravity, as it moves so. */
export function closingOf(gap, speed, pull, seconds, lastSeconds, subSeconds) {
    const start = Math.max(0.5 * speed, speed + 0.5 * pull * subSeconds), length = gap < 0 ? lastSeconds : seconds;
    return length > 0 ? Math.min(2, Math.max(-1, 2 * gap / (start + Math.sqrt(Math.max(0, start * start + 2 * pull * gap))) / length)) : 0;
}
