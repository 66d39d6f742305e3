// SPDX-License-Identifier: MIT
// Rapier 2D: it looks before it moves, ahead of itself, and solves in small steps. So a blow is told by speed and restitution, and what goes on touching
// by momentum.
import { Haptics, meeting, motionAt } from './haptics.js';

const nearMetres = 0.005; // what lies within goes on touching, though Rapier pushes it in some steps only

class RapierHaptics extends Haptics {
    #engine; #touching = new Set(); #was = new Set();

    constructor(physvib, engine, options) {
        const unit = options.metresPerUnit ?? 1;
        super(physvib, {
            keyOf: body => body.handle,
            massesOf: body => (body.isDynamic() ? { massKg: body.mass(), inertia: body.principalInertia() * unit * unit, gravityScale: body.gravityScale() } : { massKg: 0, inertia: 0, gravityScale: 1 }),
            isThere: body => engine.bodies.contains(body.handle),
            bodies: () => engine.bodies.getAll(),
            look: body => {
                const colliders = Array.from({ length: body.numColliders() }, (_, i) => body.collider(i));
                return { isEnabled: body.isEnabled(), isSensor: colliders.every(collider => collider.isSensor()), isAsleep: body.isDynamic() && body.isSleeping(),
                    filters: colliders.map(collider => ({ category: collider.collisionGroups() >>> 16, mask: collider.collisionGroups() & 0xffff, group: 0 })) };
            },
        }, options);
        this.#engine = engine;
    }

    /** `advance` steps the engine by `seconds`; without it, we do. */
    step(seconds, advance = () => this.#engine.step()) {
        const engine = this.#engine, unit = this.metresPerUnit, { x: gx, y: gy } = engine.gravity;
        engine.timestep = seconds;
        this.#meetAll();
        this.begin(seconds, Math.hypot(gx, gy) * unit);
        try {
            for (const known of this.each()) this.#observe(known, seconds);
            advance(seconds);
            for (const known of this.each()) {
                if (known.isStatic) continue;
                const { x, y } = known.body.linvel();
                this.world.moved(known.id, x * unit, y * unit, known.body.angvel());
            }
            [this.#was, this.#touching] = [this.#touching, new Set()];
            this.#eachPair((one, other) => this.#look(one, other, seconds));
        } finally {
            this.finish();
        }
    }
    update(seconds) { this.step(seconds); }

    #eachPair(use) {
        const done = new Set(), engine = this.#engine;
        engine.forEachCollider(one => {
            if (!one.parent()?.isDynamic() || one.isSensor()) return;
            engine.contactPairsWith(one, other => {
                const key = one.handle < other.handle ? `${one.handle},${other.handle}` : `${other.handle},${one.handle}`;
                if (done.has(key) || other.isSensor() || !other.parent()) return;
                done.add(key);
                use(one, other, key);
            });
        });
    }

    // A body that touches for the first time is known before the step that it touches in.
    #meetAll() {
        this.#engine.forEachCollider(collider => {
            const body = collider.parent();
            if (!body || collider.isSensor()) return;
            const known = this.know(body), { x, y } = collider.translation();
            known.isRound = collider.shapeType() === 0; // ShapeType.Ball
            known.poses = (known.poses ?? new Map()).set(collider.handle, { x, y, angle: collider.rotation() });
        });
    }

    #observe(known, seconds) {
        const { body } = known, unit = this.metresPerUnit, { x: gx, y: gy } = this.#engine.gravity, at = body.worldCom(), v = body.linvel();
        const pull = known.isStatic || body.isSleeping() ? 0 : seconds * known.gravityScale * unit;
        Object.assign(known, { x: at.x * unit, y: at.y * unit, vx: v.x * unit, vy: v.y * unit, spin: body.angvel() }); // as they are when Rapier looks
        this.world.move(known.id, known.x, known.y, known.vx + pull * gx, known.vy + pull * gy, known.spin);
    }

    #look(one, other, seconds) {
        const a = this.know(one.parent()), b = this.know(other.parent());
        if (a === b) return;
        this.#engine.contactPair(one, other, (manifold, isFlipped) => {
            const turn = isFlipped ? -1 : 1, normal = manifold.normal(), nx = turn * normal.x, ny = turn * normal.y;
            const pose = isFlipped ? b.poses.get(other.handle) : a.poses.get(one.handle), key = `${a.id},${b.id}`;
            for (let i = 0; i < manifold.numContacts(); ++i) this.#point(manifold, i, { a, b, nx, ny, pose, key, seconds });
        });
    }

    #point(manifold, i, { a, b, nx, ny, pose, key, seconds }) {
        const unit = this.metresPerUnit, impulse = manifold.contactImpulse(i), gap = manifold.contactDist(i) * unit, local = manifold.localContactPoint1(i); // solverContactPoint(i) is not contact i's
        if (local === null || pose === undefined) return;
        const cos = Math.cos(pose.angle), sin = Math.sin(pose.angle);
        const x = (pose.x + cos * local.x - sin * local.y) * unit, y = (pose.y + sin * local.x + cos * local.y) * unit;
        const { gravity } = this.#engine, { approach, alongA, alongB } = motionAt(a, b, x, y, nx, ny);
        const falls = known => (known.isStatic || known.body.isSleeping() ? 0 : known.gravityScale), pull = (falls(a) - falls(b)) * (gravity.x * nx + gravity.y * ny) * unit;
        const slack = 0.05 + Math.hypot(gravity.x, gravity.y) * unit * seconds, rests = this.#was.has(key) && gap < nearMetres && Math.abs(approach) < slack;
        if (!(impulse > 0) && !rests) return; // near, and not yet there
        this.#touching.add(key);
        this.world.touch(a.id, b.id, { x, y, normalX: nx, normalY: ny, alongA, alongB, impulse: Math.max(0, impulse * unit), isSoft: true,
            restitution: Math.min(1, Math.max(0, manifold.restitution())), ...meeting(approach, gap, pull, seconds), point: a.isRound || b.isRound ? 0 : 'place' });
    }
}

/** `world`: Rapier's. Values are those of a rigid body, whichever of its colliders touches. */
export function attach(physvib, world, options = {}) { return new RapierHaptics(physvib, world, options); }
