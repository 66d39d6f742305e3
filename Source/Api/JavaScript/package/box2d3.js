// SPDX-License-Identifier: MIT
// Box2D 3 by box2d3-wasm: soft contacts in small steps. Contacts are read after the step, so no shape needs hit events.
import { Haptics, meeting, motionAt } from './haptics.js';

const mostContacts = 64; // of a body in a step

class Box2d3Haptics extends Haptics {
    #b2; #engine; #threshold;

    constructor(physvib, engine, { b2, restitutionThreshold = 1, ...options }) {
        const unit = options.metresPerUnit ?? 1, { value: dynamic } = b2.b2BodyType.b2_dynamicBody;
        super(physvib, {
            keyOf: body => body.index1 * 65536 + body.generation,
            massesOf: body => (b2.b2Body_GetType(body).value === dynamic
                ? { massKg: b2.b2Body_GetMass(body), inertia: b2.b2Body_GetRotationalInertia(body) * unit * unit, gravityScale: b2.b2Body_GetGravityScale(body) }
                : { massKg: 0, inertia: 0, gravityScale: 1 }),
            isThere: body => b2.b2Body_IsValid(body),
            bodies: () => [], // it lists none: filters are not seen
            look: body => ({ isEnabled: b2.b2Body_IsEnabled(body), isAsleep: !b2.b2Body_IsAwake(body), filters: [] }),
        }, options);
        this.#b2 = b2;
        this.#engine = engine;
        this.#threshold = restitutionThreshold * unit;
    }

    /** `advance` calls b2World_Step; without it, we do, with four sub-steps. */
    step(seconds, advance = () => this.#b2.b2World_Step(this.#engine, seconds, 4)) {
        const b2 = this.#b2, unit = this.metresPerUnit, gravity = b2.b2World_GetGravity(this.#engine), gx = gravity.x * unit, gy = gravity.y * unit;
        this.begin(seconds, Math.hypot(gx, gy));
        try {
            for (const known of this.each()) this.#observe(known, seconds, gx, gy);
            advance(seconds);
            for (const known of this.each()) {
                if (known.isStatic) continue;
                const v = b2.b2Body_GetLinearVelocity(known.body);
                this.world.moved(known.id, v.x * unit, v.y * unit, b2.b2Body_GetAngularVelocity(known.body));
            }
            this.#lookAtAll(seconds, gx, gy);
        } finally {
            this.finish();
        }
    }
    update(seconds) { this.step(seconds); }

    #observe(known, seconds, gx, gy) {
        const b2 = this.#b2, unit = this.metresPerUnit, at = b2.b2Body_GetWorldCenterOfMass(known.body), v = b2.b2Body_GetLinearVelocity(known.body);
        known.isAwake = b2.b2Body_IsAwake(known.body);
        Object.assign(known, { x: at.x * unit, y: at.y * unit, vx: v.x * unit, vy: v.y * unit, spin: b2.b2Body_GetAngularVelocity(known.body) });
        const pull = known.isStatic || !known.isAwake ? 0 : seconds * known.gravityScale;
        this.world.move(known.id, known.x, known.y, known.vx + pull * gx, known.vy + pull * gy, known.spin);
    }

    // Each contact once: with the second of its bodies, or with the first where that is static.
    #lookAtAll(seconds, gx, gy) {
        const b2 = this.#b2, done = new Set();
        for (const { body, isStatic } of [...this.each()]) { // who touches first is known from then on
            if (isStatic || b2.b2Body_GetContactCapacity(body) === 0) continue;
            for (const data of b2.b2Body_GetContactData(body, mostContacts)) {
                const key = `${data.shapeIdA.index1},${data.shapeIdB.index1}`;
                if (done.has(key)) continue;
                done.add(key);
                this.#look(data, seconds, gx, gy);
            }
        }
    }

    #look(data, seconds, gx, gy) {
        const b2 = this.#b2, { shapeIdA, shapeIdB, manifold } = data, a = this.know(b2.b2Shape_GetBody(shapeIdA)), b = this.know(b2.b2Shape_GetBody(shapeIdB));
        const { x: nx, y: ny } = manifold.normal, falls = known => (known.isStatic || !known.isAwake ? 0 : known.gravityScale), pull = (falls(a) - falls(b)) * (gx * nx + gy * ny);
        const isRound = [shapeIdA, shapeIdB].map(shape => b2.b2Shape_GetType(shape).value === b2.b2ShapeType.b2_circleShape.value);
        [a.isRound, b.isRound] = isRound;
        const bounce = Math.max(b2.b2Shape_GetRestitution(shapeIdA), b2.b2Shape_GetRestitution(shapeIdB));
        for (let i = 0; i < manifold.pointCount; ++i) {
            const point = manifold.GetPoint(i), unit = this.metresPerUnit, gap = point.separation * unit, speed = -point.normalVelocity * unit;
            if (point.totalNormalImpulse <= 0 && gap > 0) continue; // near, and not yet there
            const x = point.point.x * unit, y = point.point.y * unit, { alongA, alongB } = motionAt(a, b, x, y, nx, ny);
            this.world.touch(a.id, b.id, { x, y, normalX: nx, normalY: ny, alongA, alongB, 
                impulse: Math.max(0, 0.5 * point.totalNormalImpulse * unit), isSoft: 'whole', // it counts a sub-step twice: solved, and relaxed
                restitution: speed > this.#threshold ? Math.min(1, Math.max(0, bounce)) : 0, ...meeting(speed, gap, pull, seconds), point: isRound.includes(true) ? 0 : point.id });
        }
    }
}

/** `world`: a b2WorldId; options.b2: the module that Box2D3() gives. Bodies are b2BodyIds. */
export function attach(physvib, world, options) { return new Box2d3Haptics(physvib, world, options); }
