// SPDX-License-Identifier: MIT
// Attaches to Rapier 3D: as Rapier 2D, with positions, normals and motions in space.
import { expectRapier, RapierHaptics } from './rapier2d.js';
import { dot, lostAt, nowhere, plus, spotAt, stopBefore, stopBehind, turn } from './space.js';

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
        stopBefore(known, free);
        this.journal.moveInSpace(known.id, at, free, known.turns, inverse);
    }
    ended({ stop, body }, seconds, subSeconds) {
        stopBehind(stop, plus(nowhere, body.worldCom(), this.metresPerUnit), plus(nowhere, body.linvel(), this.metresPerUnit), seconds, subSeconds);
    }
    lostAt(known, spot) { return lostAt(known, spot); }
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
        spot.gap = unit * dot(plus(second, first, -1), m);
        spotAt(a, b, at, n, spot);
    }
}

/** `world`: Rapier's. Values are those of a rigid body, whichever of its colliders touches. */
export function attach(physvib, world, options = {}) {
    expectRapier(world);
    return new RapierHaptics3D(physvib, world, options);
}
