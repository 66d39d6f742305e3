// SPDX-License-Identifier: MIT
// Rapier 3D: as Rapier 2D, with places, normals and motions in space.
import { expectRapier, RapierHaptics } from './rapier2d.js';
import { endOf, startOf, stopOf } from './stops.js';

const plus = (a, b, times = 1) => ({ x: a.x + times * b.x, y: a.y + times * b.y, z: a.z + times * b.z });
const dot = (a, b) => a.x * b.x + a.y * b.y + a.z * b.z;
const cross = (a, b) => ({ x: a.y * b.z - a.z * b.y, y: a.z * b.x - a.x * b.z, z: a.x * b.y - a.y * b.x });
const nowhere = { x: 0, y: 0, z: 0 };
/** A point turned by a quaternion. */
const turn = (q, p) => {
    const t = cross(q, p);
    return plus(plus(p, t, 2 * q.w), cross(q, t), 2);
};

class RapierHaptics3D extends RapierHaptics {
    inertiaOf(body) { return dot(body.principalInertia(), { x: 1, y: 1, z: 1 }) / 3; }
    size(vector) { return Math.sqrt(dot(vector, vector)); }
    product(a, b) { return dot(a, b); }

    between(a, b) { return Math.sqrt((b.x - a.x) ** 2 + (b.y - a.y) ** 2 + (b.z - a.z) ** 2); }
    observe(known, pull, gravity) {
        const { body } = known, unit = this.metresPerUnit, { m11, m22, m33, m12, m13, m23 } = body.effectiveWorldInvInertia();
        const inverse = known.isStatic ? null : [m11, m22, m33, m12, m13, m23].map(m => m / (unit * unit));
        Object.assign(known, { at: plus(nowhere, body.worldCom(), unit), v: plus(nowhere, this.velocityOf(known), unit), turns: body.angvel() });
        known.inverse = inverse;
        const { at, v } = known, free = plus(v, gravity, pull);
        if (!known.isStatic) startOf(known.stop ??= stopOf(), at.x, at.y, at.z, v.x, v.y, v.z, free.x, free.y, free.z);
        this.journal.moveInSpace(known.id, at, free, known.turns, inverse);
    }
    ended({ stop, body }, seconds, subSeconds) {
        const at = plus(nowhere, body.worldCom(), this.metresPerUnit), v = plus(nowhere, body.linvel(), this.metresPerUnit);
        endOf(stop, at.x, at.y, at.z, v.x, v.y, v.z, seconds, subSeconds);
    }
    lostAt({ stop, at, turns }, { x, y, z, normalX, normalY, normalZ }) {
        return stop ? dot(plus({ x: stop.toX, y: stop.toY, z: stop.toZ }, cross(turns, plus({ x, y, z }, at, -1)), stop.turn), { x: normalX, y: normalY, z: normalZ }) : 0;
    }
    observeAgain(known) { this.journal.moveInSpace(known.id, known.at, known.v, known.turns, known.inverse); }
    movedAgain(known) { this.journal.movedInSpace(known.id, known.v, known.turns); }
    observeStill(known, at) {
        Object.assign(known, { at: plus(nowhere, at, this.metresPerUnit), v: nowhere, turns: nowhere });
        this.journal.moveInSpace(known.id, known.at, nowhere, nowhere, null);
    }
    moved(known, v, spin) { this.journal.movedInSpace(known.id, plus(nowhere, v, this.metresPerUnit), spin); }

    lookAt(manifold, i, one, other, m, way, a, b) {
        const unit = this.metresPerUnit, spot = this.spot, n = { x: way * m.x, y: way * m.y, z: way * m.z };
        const place = ({ at, turned, radius }, side, local) => plus(at, radius > 0 ? plus(nowhere, m, side * radius) : turn(turned, local));
        const first = place(one, 1, one.radius > 0 ? null : manifold.localContactPoint1(i)), second = place(other, -1, other.radius > 0 ? null : manifold.localContactPoint2(i));
        const isFirst = one.radius > 0 || (other.radius === 0 && (way > 0 ? !a.isStatic && b.isStatic : !b.isStatic && a.isStatic)), at = plus(nowhere, isFirst ? first : second, unit); // the point of what moves
        const va = plus(a.v, cross(a.turns, plus(at, a.at, -1))), vb = plus(b.v, cross(b.turns, plus(at, b.at, -1)));
        const point = b.isRound ? b.v : a.isRound ? a.v : b.isStatic ? va : vb; // goes with a round body's centre, or with the corner of what moves
        const across = v => plus(v, n, -dot(v, n)), ua = across(plus(point, va, -1)), ub = across(plus(point, vb, -1));
        const along = this.size(ua) > this.size(ub) ? ua : ub, length = this.size(along) || 1; // in which grains are passed
        spot.x = at.x;
        spot.y = at.y;
        spot.z = at.z;
        spot.normalX = n.x;
        spot.normalY = n.y;
        spot.normalZ = n.z;
        spot.gap = unit * dot(plus(second, first, -1), m);
        spot.approach = dot(plus(va, vb, -1), n);
        spot.alongA = dot(ua, along) / length;
        spot.alongB = dot(ub, along) / length;
    }
}

/** `world`: Rapier's. Values are those of a rigid body, whichever of its colliders touches. */
export function attach(physvib, world, options = {}) {
    expectRapier(world);
    return new RapierHaptics3D(physvib, world, options);
}
