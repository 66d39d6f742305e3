// SPDX-License-Identifier: MIT
// Geometry of boxes and circles for velocities.js: distance, neighbours and contact points. Thousands per step are usual, so nothing is allocated.

/** m: bodies that are nearer touch, if their velocities say so. */
export const skin = 0.02;

/** How far two bodies are apart, and the normal from a to b; boxes are not turned. */
export function apart(a, b, out) {
    const dx = b.x - a.x, dy = b.y - a.y;
    if (a.radius > 0 && b.radius > 0) {
        const length = Math.sqrt(dx * dx + dy * dy);
        return filled(out, length - a.radius - b.radius, length > 0 ? dx / length : 0, length > 0 ? dy / length : 1);
    }
    const outX = Math.abs(dx) - a.halfWidth - b.halfWidth, outY = Math.abs(dy) - a.halfHeight - b.halfHeight;
    const box = a.radius > 0 ? b : a, circle = a.radius > 0 ? a : b, way = a.radius > 0 ? -1 : 1;
    if (circle.radius > 0 && outX > -circle.radius && outY > -circle.radius) { // at a corner
        const cx = circle.x - box.x, cy = circle.y - box.y, px = cx - Math.sign(cx) * box.halfWidth, py = cy - Math.sign(cy) * box.halfHeight, length = Math.hypot(px, py);
        if (px * cx > 0 && py * cy > 0 && length > 0) return filled(out, length - circle.radius, way * px / length, way * py / length);
    }
    return outX > outY ? filled(out, outX, Math.sign(dx) || 1, 0) : filled(out, outY, 0, Math.sign(dy) || 1);
}
function filled(out, gap, nx, ny) {
    out.gap = gap;
    out.nx = nx;
    out.ny = ny;
    return out;
}

/** What is known of a body in one step, and `before` it. */
export const stateOf = () => ({ x: 0.5, y: 0.5, vx: 0.5, vy: 0.5, spin: 0.5, width: 0, height: 0, radius: 0.5, massKg: 1, gravityScale: 1, halfWidth: 0.5, halfHeight: 0.5, body: null, before: null, left: 0.5, right: 0.5, turn: 0 });
export function copy(from, to) {
    to.x = from.x;
    to.y = from.y;
    to.vx = from.vx;
    to.vy = from.vy;
    to.spin = from.spin;
    to.radius = from.radius;
    to.halfWidth = from.halfWidth;
    to.halfHeight = from.halfHeight;
    to.massKg = from.massKg;
    to.gravityScale = from.gravityScale;
}

/** Four bodies around `bounds`: left, right, and those along y. */
export function putWalls(walls, { x, y, width, height }) {
    const deep = Math.max(width, height);
    for (const [i, wall] of walls.entries()) {
        const isSide = i < 2, way = i % 2 ? 1 : -1;
        Object.assign(wall, { x: x + width / 2 + (isSide ? way * (width + deep) / 2 : 0), y: y + height / 2 + (isSide ? 0 : way * (height + deep) / 2), width: isSide ? deep : width + 2 * deep, height: isSide ? height : deep });
    }
}

const mayMeet = (a, b) => Math.abs(a.y - b.y) < a.halfHeight + b.halfHeight + skin + Math.abs(a.y - a.before.y) + Math.abs(b.y - b.before.y);

/** `use` of any two that may meet in a step. `order`: all, along x, which few leave from one step to the next, so that it is set in order in place. */
export function eachNear(order, use) {
    const { length } = order;
    for (const state of order) {
        const reach = state.halfWidth + skin + Math.abs(state.x - state.before.x);
        state.left = state.x - reach;
        state.right = state.x + reach;
        if (!(state.left - state.right < Infinity)) state.left = state.right = Infinity; // no numbers
    }
    for (let i = 1; i < length; ++i) {
        const state = order[i];
        let at = i;
        for (; at > 0 && order[at - 1].left > state.left; --at) order[at] = order[at - 1];
        order[at] = state;
    }
    for (let i = 0; i < length; ++i) for (let j = i + 1; j < length && order[j].left < order[i].right; ++j) if (mayMeet(order[i], order[j])) use(order[i], order[j]);
}

/** Where two bodies meet: on the surface of the round one, or in the middle of the sides that meet. */
export function between(a, b, nx, ny) {
    if (a.radius > 0) return { x: a.x + a.radius * nx, y: a.y + a.radius * ny };
    if (b.radius > 0) return { x: b.x - b.radius * nx, y: b.y - b.radius * ny };
    const middle = (p, q, halfP, halfQ) => (Math.max(p - halfP, q - halfQ) + Math.min(p + halfP, q + halfQ)) / 2;
    return nx !== 0 ? { x: a.x + nx * a.halfWidth, y: middle(a.y, b.y, a.halfHeight, b.halfHeight) } : { x: middle(a.x, b.x, a.halfWidth, b.halfWidth), y: a.y + ny * a.halfHeight };
}
