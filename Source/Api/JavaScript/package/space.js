// SPDX-License-Identifier: MIT
// Vectors { x, y, z }, and motions of bodies in space.
import { endOf, startOf, stopOf } from './stops.js';

export const plus = (a, b, times = 1) => ({ x: a.x + times * b.x, y: a.y + times * b.y, z: a.z + times * b.z });
export const dot = (a, b) => a.x * b.x + a.y * b.y + a.z * b.z;
export const cross = (a, b) => ({ x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x });
export const nowhere = { x: 0, y: 0, z: 0 };
/** A point turned by a quaternion. */
export const turn = (q, p) => {
    const t = cross(q, p);
    return plus(plus(p, t, 2 * q.w), cross(q, t), 2);
};
export const sizeOf = v => Math.sqrt(dot(v, v));

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
