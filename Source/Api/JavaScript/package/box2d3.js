// SPDX-License-Identifier: MIT
// Attaches to Box2D 3 (box2d3-wasm), which has soft contacts in small steps. Contacts are read after the step, so no shape needs hit events.
import { Haptics, motionAt } from './haptics.js';
import { contactOf, leftOut } from './journal.js';
import { closingOf, endOf, startOf, stopOf } from './stops.js';

const mostContacts = 64; // of a body in a step

class Box2d3Haptics extends Haptics {
    #b2; #engine; #threshold; #subSteps; #lastSeconds = 0; #spot = Object.assign(contactOf(), { soft: 1 });

    constructor(physvib, engine, { b2, restitutionThreshold = 1, subSteps = 4, ...options }) {
        const unit = options.metresPerUnit ?? 1, { value: dynamic } = b2.b2BodyType.b2_dynamicBody;
        super(physvib, {
            bodyOf: body => (body?.index1 > 0 ? body : undefined),
            keyOf: body => body.index1 * 65536 + body.generation,
            massesOf: body => (b2.b2Body_IsValid(body) && b2.b2Body_GetType(body).value === dynamic
                ? { massKg: b2.b2Body_GetMass(body), inertia: b2.b2Body_GetMotionLocks?.(body).angularZ ? 0 : b2.b2Body_GetRotationalInertia(body) * unit * unit, gravityScale: b2.b2Body_GetGravityScale(body) }
                : { massKg: 0, inertia: 0, gravityScale: 1 }),
            options: ['b2', 'restitutionThreshold', 'subSteps'], isThere: body => b2.b2Body_IsValid(body),
            bodies: () => [], // it lists none: filters are not seen
            look: body => ({ isEnabled: b2.b2Body_IsEnabled(body), isAsleep: !b2.b2Body_IsAwake(body), filters: [] }),
        }, options);
        this.#b2 = b2;
        this.#engine = engine;
        this.#threshold = restitutionThreshold * unit;
        this.#subSteps = subSteps;
    }

    /** `advance` calls b2World_Step; without it, we do. */
    step(seconds, advance = () => this.#b2.b2World_Step(this.#engine, seconds, this.#subSteps)) {
        const { x, y } = this.#b2.b2World_GetGravity(this.#engine), gx = x * this.metresPerUnit, gy = y * this.metresPerUnit;
        this.around(() => advance(seconds), () => {
            this.begin(seconds, Math.hypot(gx, gy));
            for (const known of this.each()) this.#observe(known, seconds, gx, gy);
        }, () => this.#after(seconds, gx, gy));
    }
    #after(seconds, gx, gy) {
        const moving = [...this.eachThere()].filter(({ isStatic }) => !isStatic);
        for (const known of moving) {
            known.after = this.#motionOf(known.body);
            this.journal.moved(known.id, known.after.vx, known.after.vy, known.after.spin);
        }
        this.#lookAtAll(seconds, gx, gy);
        for (const { stop, after } of moving) endOf(stop, after.x, after.y, 0, after.vx, after.vy, 0, seconds, seconds / this.#subSteps); // for the next step's contacts
        this.#lastSeconds = seconds;
    }
    update(seconds) { this.step(seconds); }

    #motionOf(body) {
        const b2 = this.#b2, unit = this.metresPerUnit, at = b2.b2Body_GetWorldCenterOfMass(body), v = b2.b2Body_GetLinearVelocity(body);
        return { x: at.x * unit, y: at.y * unit, vx: v.x * unit, vy: v.y * unit, spin: b2.b2Body_GetAngularVelocity(body) };
    }

    #observe(known, seconds, gx, gy) {
        known.isAwake = this.#b2.b2Body_IsAwake(known.body);
        Object.assign(known, this.#motionOf(known.body));
        const pull = known.isStatic || !known.isAwake ? 0 : seconds * known.gravityScale, vx = known.vx + pull * gx, vy = known.vy + pull * gy;
        startOf(known.stop ??= stopOf(), known.x, known.y, 0, known.vx, known.vy, 0, vx, vy, 0);
        this.journal.move(known.id, known.x, known.y, vx, vy, known.spin);
    }

    // Each contact once: with the second of its bodies, or with the first where that is static.
    #lookAtAll(seconds, gx, gy) {
        const b2 = this.#b2, done = new Set();
        for (const { body, isStatic, values } of [...this.each()]) { // who touches first is known from then on
            if ((isStatic && !values.isSource) || b2.b2Body_GetContactCapacity(body) === 0) continue;
            for (const data of b2.b2Body_GetContactData(body, mostContacts)) {
                const key = `${data.shapeIdA.index1},${data.shapeIdB.index1}`;
                if (done.has(key)) continue;
                done.add(key);
                this.#look(data, seconds, gx, gy);
            }
        }
    }

    #met(shape, seconds, gx, gy) {
        const known = this.know(this.#b2.b2Shape_GetBody(shape));
        if (known.stop === undefined) this.#observe(known, seconds, gx, gy);
        return known;
    }
    #look(data, seconds, gx, gy) {
        const b2 = this.#b2, { shapeIdA, shapeIdB, manifold } = data, a = this.#met(shapeIdA, seconds, gx, gy), b = this.#met(shapeIdB, seconds, gx, gy);
        const { x: nx, y: ny } = manifold.normal, falls = known => (known.isStatic || !known.isAwake ? 0 : known.gravityScale), pull = (falls(a) - falls(b)) * (gx * nx + gy * ny);
        const isRound = [shapeIdA, shapeIdB].map(shape => b2.b2Shape_GetType(shape).value === b2.b2ShapeType.b2_circleShape.value);
        [a.isRound, b.isRound] = isRound;
        const bounce = Math.max(b2.b2Shape_GetRestitution(shapeIdA), b2.b2Shape_GetRestitution(shapeIdB));
        for (let i = 0; i < manifold.pointCount; ++i) {
            const point = manifold.GetPoint(i), unit = this.metresPerUnit, gap = point.separation * unit, speed = -point.normalVelocity * unit;
            if (point.totalNormalImpulse <= 0 && gap > 0) continue; // near, and not yet there
            const x = point.point.x * unit, y = point.point.y * unit, spot = motionAt(a, b, x, y, nx, ny, this.#spot), isAhead = speed > 0;
            const lost = ({ stop, ...known }) => (stop ? stop.toX * nx + stop.toY * ny + stop.turn * known.spin * ((x - known.x) * ny - (y - known.y) * nx) : 0);
            const turn = known => -known.spin * known.spin * ((x - known.x) * nx + (y - known.y) * ny), squared = speed * speed + 2 * pull * Math.max(0, gap);
            this.journal.touch(a.id, b.id, Object.assign(spot, { x, y, normalX: nx, normalY: ny, approach: isAhead && squared > 0 ? Math.sqrt(squared) : speed,
                fraction: isAhead ? closingOf(gap + Math.min(0, lost(b) - lost(a)), speed, pull + turn(a) - turn(b), seconds, this.#lastSeconds, seconds / this.#subSteps) : leftOut, gap: isAhead ? leftOut : gap, gapFraction: isAhead ? leftOut : 0,
                impulse: Math.max(0, 0.5 * point.totalNormalImpulse * unit), // it counts a sub-step twice: solved, and relaxed
                restitution: speed > this.#threshold ? Math.min(1, Math.max(0, bounce)) : 0, point: isRound.includes(true) ? 0 : point.id }));
        }
    }
}

/** `world`: a b2WorldId; options.b2: the module that Box2D3() gives. Bodies are b2BodyIds. */
export function attach(physvib, world, options) { return new Box2d3Haptics(physvib, world, options); }
