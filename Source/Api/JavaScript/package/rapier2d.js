// SPDX-License-Identifier: MIT
// Rapier 2D: it looks before it moves, ahead of itself, and solves in small steps. So a blow is told by speed and restitution, and what goes on touching
// by momentum.
import { expectEngine, Haptics, meeting, motionAt } from './haptics.js';

const nearMetres = 0.005; // what lies within goes on touching, though Rapier pushes it in some steps only

/** Whose contacts a collider's are: its body's, or its own where it has none, as a ground often has not. */
const ownerOf = collider => collider.parent() ?? collider;

/** The point of a collider at its pose, `local` to it; `way`: whether the normal goes out of it (1) or in. */
function onSurface({ at, turned, radius }, normal, way, local) {
    if (radius > 0) return { x: at.x + way * radius * normal.x, y: at.y + way * radius * normal.y };
    const cos = Math.cos(turned), sin = Math.sin(turned);
    return { x: at.x + cos * local.x - sin * local.y, y: at.y + sin * local.x + cos * local.y };
}

const pairOf = (a, b) => (a < b ? a * 2 ** 26 + b : b * 2 ** 26 + a);

/** What both have; physvib/rapier3d says otherwise what space changes. */
export class RapierHaptics extends Haptics {
    #engine; #touching = new Set(); #was = new Set(); #kept = new Map(); #count = 0; #done = new Set();

    constructor(physvib, engine, options) {
        const unit = options.metresPerUnit ?? 1;
        super(physvib, {
            bodyOf: thing => (thing?.isDynamic ? thing : thing?.shapeType ? ownerOf(thing) : undefined),
            keyOf: body => body,
            massesOf: body => (this.engine.isThere(body) && body.isDynamic?.() ? { massKg: body.mass(), inertia: this.inertiaOf(body) * unit * unit, gravityScale: body.gravityScale() } : { massKg: 0, inertia: 0, gravityScale: 1 }),
            // Rapier gives a handle's place to the next body, and calls of the old one end its module.
            isThere: body => (body.isDynamic ? engine.bodies : engine.colliders).get(body.handle) === body,
            bodies: () => [...engine.bodies.getAll(), ...engine.colliders.getAll().filter(collider => !collider.parent())],
            look: body => {
                const colliders = body.isDynamic ? Array.from({ length: body.numColliders() }, (_, i) => body.collider(i)) : [body];
                return { isEnabled: body.isEnabled(), isSensor: colliders.every(collider => collider.isSensor()), isAsleep: body.isDynamic?.() && body.isSleeping(),
                    filters: colliders.map(collider => ({ category: collider.collisionGroups() >>> 16, mask: collider.collisionGroups() & 0xffff, group: 0 })) };
            },
        }, options);
        this.#engine = engine;
    }

    /** `advance` steps the engine by `seconds`; without it, we do. */
    step(seconds, advance = () => this.#engine.step()) {
        this.#engine.timestep = seconds;
        this.around(() => advance(seconds), () => this.#before(seconds), () => this.#after(seconds));
    }
    #before(seconds) {
        this.#rest();
        this.begin(seconds, this.size(this.#engine.gravity) * this.metresPerUnit);
        this.#meetAll();
        for (const known of this.each()) this.#observe(known, seconds);
    }
    #observe(known, seconds) {
        if (known.isAtRest) this.observeAgain(known);
        else if (known.body.isDynamic) this.observe(known, this.#pullOf(known, seconds));
        else this.observeStill(known, known.body.translation());
    }
    #after(seconds) {
        for (const known of this.eachThere()) {
            if (known.isStatic) continue;
            if (known.isAtRest && !known.body.isSleeping()) known.isAtRest = false; // something has woken it
            if (known.isAtRest) this.movedAgain(known);
            else this.moved(known, known.body.linvel(), known.body.angvel());
        }
        [this.#was, this.#touching] = [this.#touching, this.#was];
        this.#touching.clear();
        this.#eachPair((one, other) => this.#look(one, other, seconds));
    }
    update(seconds) { this.step(seconds); }

    // What is known of a collider: its number, and its contacts as they were observed while its body slept.
    #keptOf(collider) {
        let kept = this.#kept.get(collider);
        if (kept === undefined) this.#kept.set(collider, kept = { number: ++this.#count, isSeen: false, contacts: null, pairs: [], touching: [] });
        return kept;
    }
    #eachPair(use) {
        const done = this.#done, engine = this.#engine;
        done.clear();
        engine.forEachCollider(one => {
            const parent = one.parent(), kept = this.#keptOf(one);
            kept.isSeen = true;
            if (!parent?.isDynamic()) return;
            const { isAtRest } = this.know(one);
            if (isAtRest && kept.contacts !== null) {
                for (const key of kept.pairs) done.add(key);
                for (const key of kept.touching) this.#touching.add(key);
                this.journal.again(kept.contacts);
                return;
            }
            kept.contacts = null;
            if (one.isSensor()) return;
            const { place } = this.journal, pairs = [], before = this.#touching.size;
            engine.contactPairsWith(one, other => {
                const { number } = this.#keptOf(other), key = pairOf(kept.number, number);
                if (done.has(key) || other.isSensor()) return;
                done.add(key);
                pairs.push(key);
                use(one, other);
            });
            if (isAtRest) Object.assign(kept, { contacts: this.journal.copy(place), pairs, touching: [...this.#touching].slice(before) });
        });
        for (const [collider, kept] of this.#kept) if (kept.isSeen) kept.isSeen = false; else this.#kept.delete(collider);
    }

    // A body that sleeps lies where it lay, with its masses, until something wakes it.
    #rest() {
        for (const known of this.eachThere()) {
            const isAsleep = !known.isStatic && known.body.isSleeping();
            known.isAtRest = isAsleep && known.hasSlept === true && known.poses?.size === known.body.numColliders();
            known.hasSlept = isAsleep;
            if (!known.isAtRest) known.poses?.clear();
        }
    }
    // A body that touches for the first time is known before the step that it touches in.
    #meetAll() {
        this.#engine.forEachCollider(collider => {
            const known = this.#known(collider);
            if (known?.isAtRest) return;
            if (collider.isSensor()) return;
            this.#pose(known ?? this.know(collider), collider);
        });
    }
    // Of what is known already: a sensor need not be.
    #known(collider) { const known = this.known(ownerOf(collider)); return known?.isGone ? undefined : known; }
    #pose(known, collider) {
        known.isRound = collider.shapeType() === 0; // ShapeType.Ball
        known.poses = (known.poses ?? new Map()).set(collider, { at: collider.translation(), turned: collider.rotation(), radius: known.isRound ? collider.radius() : 0 });
    }

    #fall(known) { return known.isStatic || known.isAtRest || known.body.isSleeping() ? 0 : known.gravityScale; }
    #pullOf(known, seconds) {
        const { x, y, z } = this.#engine.gravity, pull = seconds * this.#fall(known) * this.metresPerUnit;
        return { x: pull * x, y: pull * y, z: pull * z };
    }

    inertiaOf(body) { return body.principalInertia(); }
    size({ x, y }) { return Math.hypot(x, y); }
    product(a, b) { return a.x * b.x + a.y * b.y; }
    /** Motion before the step, as Rapier looks at it, and as its solver finds it. */
    observe(known, pull) {
        const { body } = known, unit = this.metresPerUnit, at = body.worldCom(), v = body.linvel();
        Object.assign(known, { x: at.x * unit, y: at.y * unit, vx: v.x * unit, vy: v.y * unit, spin: body.angvel() });
        this.journal.move(known.id, known.x, known.y, known.vx + pull.x, known.vy + pull.y, known.spin);
    }
    observeAgain(known) { this.journal.move(known.id, known.x, known.y, known.vx, known.vy, known.spin); }
    movedAgain(known) { this.journal.moved(known.id, known.vx, known.vy, known.spin); }
    observeStill(known, { x, y }) { this.move(known, x * this.metresPerUnit, y * this.metresPerUnit, 0, 0, 0); }
    moved(known, { x, y }, spin) { this.journal.moved(known.id, x * this.metresPerUnit, y * this.metresPerUnit, spin); }
    /** Where contact i of a manifold is, across which gap, and how both surfaces run there. `poses`: of its first and its second collider. Rapier keeps a contact's
     * points and distance for some steps while bodies move on, so they are where both bodies have them now; a ball's are where it is nearest. */
    contactOf(manifold, i, [first, second], n, a, b) {
        const unit = this.metresPerUnit, m = manifold.normal(), one = onSurface(first, m, 1, manifold.localContactPoint1(i)), other = onSurface(second, m, -1, manifold.localContactPoint2(i));
        const x = one.x * unit, y = one.y * unit, gap = ((other.x - one.x) * m.x + (other.y - one.y) * m.y) * unit;
        return { place: { x, y, normalX: n.x, normalY: n.y }, gap, motion: motionAt(a, b, x, y, n.x, n.y) };
    }

    #look(one, other, seconds) {
        const a = this.know(one), b = this.know(other);
        if (a === b) return;
        this.#engine.contactPair(one, other, (manifold, isFlipped) => {
            if (manifold.numContacts() === 0) return;
            const turn = isFlipped ? -1 : 1, { x, y, z } = manifold.normal(), normal = { x: turn * x, y: turn * y, z: turn * z };
            const both = [a.poses?.get(one), b.poses?.get(other)], poses = isFlipped ? both.reverse() : both, key = a.id * 2 ** 26 + b.id;
            for (let i = 0; i < manifold.numContacts(); ++i) this.#point(manifold, i, { a, b, normal, poses, key, seconds });
        });
    }

    #point(manifold, i, { a, b, normal, poses, key, seconds }) {
        if (manifold.localContactPoint1(i) === null || poses.includes(undefined)) return;
        const unit = this.metresPerUnit, { gravity } = this.#engine, impulse = manifold.contactImpulse(i);
        const { place, gap, motion: { approach, alongA, alongB } } = this.contactOf(manifold, i, poses, normal, a, b);
        const pull = (this.#fall(a) - this.#fall(b)) * this.product(gravity, normal) * unit;
        const slack = 0.05 + this.size(gravity) * unit * seconds, rests = this.#was.has(key) && gap < nearMetres && Math.abs(approach) < slack;
        if (!(impulse > 0) && !rests) return; // near, and not yet there
        this.#touching.add(key);
        this.journal.touch(a.id, b.id, { ...place, alongA, alongB, impulse: Math.max(0, impulse * unit), isSoft: true,
            restitution: Math.min(1, Math.max(0, manifold.restitution())), ...meeting(approach, gap, pull, seconds), point: a.isRound || b.isRound ? 0 : 'place' });
    }
}

export const expectRapier = world => expectEngine(world?.bodies && world.colliders && world.narrowPhase, "Rapier's world", world);

/** `world`: Rapier's. Values are those of a rigid body, whichever of its colliders touches. */
export function attach(physvib, world, options = {}) {
    expectRapier(world);
    return new RapierHaptics(physvib, world, options);
}
