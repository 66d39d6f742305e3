// SPDX-License-Identifier: MIT
// Attaches to Planck 1, Box2D 2.4 in JavaScript. It reports whole impulses; in the first phase of a step those of a new pair include a share of gravity.
import { expectEngine, Haptics, motionAt } from './haptics.js';
import { byPlace, contactOf, leftOut } from './journal.js';

const listed = first => {
    const all = [];
    for (let each = first; each; each = each.getNext()) all.push(each);
    return all;
};

const lookOf = contact => ({ contact, a: null, b: null, count: 0, at: 0, step: 0, isNew: false, next: null, nextPushed: null }); // `at`: of normal, alpha, and six numbers for each of two points

class PlanckHaptics extends Haptics {
    #engine; #handlers; #seconds = 0; #gravity = { x: 0, y: 0 }; #isStepping = false; #step = 0; #looks = new Map(); #numbers = []; #count = 0; #first = lookOf(null); #looked = this.#first; #pushed = this.#first; #manifold = null; #spot = contactOf();

    constructor(physvib, engine, options) {
        const unit = options.metresPerUnit ?? 1;
        super(physvib, {
            bodyOf: thing => (thing?.getFixtureList ? thing : thing?.getBody?.()), // or a fixture's
            keyOf: body => body,
            massesOf: body => (body.isDynamic() ? { massKg: body.getMass(), inertia: (body.getInertia() - body.getMass() * body.getLocalCenter().lengthSquared()) * unit * unit, gravityScale: body.getGravityScale() }
                : { massKg: 0, inertia: 0, gravityScale: 1 }),
            isThere: body => !body.m_destroyed,
            bodies: () => listed(engine.getBodyList()),
            look: body => {
                const fixtures = listed(body.getFixtureList());
                return { isEnabled: body.isActive(), isSensor: fixtures.every(fixture => fixture.isSensor()), isAsleep: !body.isStatic() && !body.isAwake(),
                    filters: fixtures.map(fixture => ({ category: fixture.getFilterCategoryBits(), mask: fixture.getFilterMaskBits(), group: fixture.getFilterGroupIndex() })) };
            },
        }, options);
        this.#engine = engine;
        this.#handlers = {
            'pre-step': seconds => this.#start(seconds), 'post-step': () => this.#end(), 'begin-contact': contact => { this.#lookOf(contact).isNew = true; }, 'end-contact': contact => { this.#lookOf(contact).contact = null; this.#looks.delete(contact); },
            'pre-solve': contact => this.guarded(this.#look, false, contact), 'post-solve': (contact, impulse) => this.guarded(this.#push, false, contact, impulse),
        };
        for (const [name, handler] of Object.entries(this.#handlers)) engine.on(name, handler);
    }
    detach() { for (const [name, handler] of Object.entries(this.#handlers)) this.#engine.off(name, handler); }

    /** world.step, or `advance`, which steps it; versions of Planck that say when they step need neither. */
    step(seconds, advance = () => this.#engine.step(seconds)) {
        this.#start(seconds);
        try { advance(seconds); } finally { this.#end(); }
    }
    update(seconds) { this.step(seconds); }

    #start(seconds) { if (!this.#isStepping) this.guarded(() => this.#begin(seconds)); }
    #begin(seconds) {
        const { x, y } = this.#engine.getGravity(), unit = this.metresPerUnit;
        this.#seconds = seconds;
        this.#gravity = { x: x * unit, y: y * unit };
        this.begin(seconds, Math.hypot(x, y) * unit);
        this.#isStepping = true;
        ++this.#step;
        this.#count = 0;
        this.#looked = this.#pushed = this.#first;
        for (const known of this.each()) this.#observe(known, known.isRound, false);
    }
    #end() {
        if (!this.#isStepping) return;
        this.#isStepping = false;
        this.finish();
    }

    // Once, unless it has changed: a body is in many contacts.
    #observe(known, isRound, falls) {
        const { body } = known, unit = this.metresPerUnit, at = body.getWorldCenter(), v = body.getLinearVelocity(), pull = falls && body.isDynamic() ? this.#seconds * body.getGravityScale() : 0;
        const x = at.x * unit, y = at.y * unit, vx = v.x * unit + pull * this.#gravity.x, vy = v.y * unit + pull * this.#gravity.y, spin = body.getAngularVelocity();
        known.isRound = isRound;
        if (known.step === this.#step && known.x === x && known.y === y && known.vx === vx && known.vy === vy && known.spin === spin) return;
        known.step = this.#step;
        this.move(known, x, y, vx, vy, spin);
    }

    // Continuous collision looks again, within the step: gravity is in the speeds then.
    #look = contact => {
        const fixtureA = contact.getFixtureA(), fixtureB = contact.getFixtureB(), bodyA = fixtureA.getBody(), bodyB = fixtureB.getBody(), unit = this.metresPerUnit;
        if (fixtureA.isSensor() || fixtureB.isSensor()) return;
        const { next } = this.#looked, look = this.#looked = this.#looked.next = next?.contact === contact ? next : this.#lookOf(contact);
        const alpha = Math.max(bodyA.m_sweep?.alpha0 ?? 0, bodyB.m_sweep?.alpha0 ?? 0), a = look.a = this.#knownOf(look.a, bodyA), b = look.b = this.#knownOf(look.b, bodyB);
        this.#observe(a, fixtureA.getType() === 'circle', alpha === 0);
        this.#observe(b, fixtureB.getType() === 'circle', alpha === 0);
        const { normal, points, separations } = this.#manifold = contact.getWorldManifold(this.#manifold), spot = this.#spot;
        look.step = this.#step;
        look.count = contact.getManifold().pointCount;
        const numbers = this.#numbers;
        let to = look.at = this.#count;
        numbers[to++] = normal.x;
        numbers[to++] = normal.y;
        numbers[to++] = alpha;
        for (let i = 0; i < look.count; ++i) {
            const x = points[i].x * unit, y = points[i].y * unit;
            motionAt(a, b, x, y, normal.x, normal.y, spot);
            numbers[to++] = x;
            numbers[to++] = y;
            numbers[to++] = spot.approach;
            numbers[to++] = spot.alongA;
            numbers[to++] = spot.alongB;
            numbers[to++] = (separations[i] ?? 0) * unit;
        }
        this.#count = to;
    };
    #knownOf(known, body) { return known?.body === body && !known.isOut ? known : this.know(body); }
    // State of a contact while it lasts. Planck visits most contacts in the order of the step before.
    #lookOf(contact) {
        let look = this.#looks.get(contact);
        if (look === undefined) this.#looks.set(contact, look = lookOf(contact));
        return look;
    }

    #push = (contact, impulse) => {
        const { nextPushed: next } = this.#pushed, look = next?.contact === contact ? next : this.#looks.get(contact);
        if (look?.step !== this.#step || !this.#isStepping) return;
        this.#pushed = this.#pushed.nextPushed = look;
        const { a, b, count, at } = look, numbers = this.#numbers, nx = numbers[at], ny = numbers[at + 1], alpha = numbers[at + 2], unit = this.metresPerUnit, spot = this.#spot;
        const pull = this.#seconds * (this.#gravity.x * nx + this.#gravity.y * ny), isOne = a.isStatic !== b.isStatic;
        const load = look.isNew && alpha === 0 && isOne ? Math.max(0, a.isStatic ? -pull * b.massKg * b.gravityScale : pull * a.massKg * a.gravityScale) : 0;
        spot.normalX = nx;
        spot.normalY = ny;
        spot.gapFraction = alpha > 0 ? leftOut : 0;
        spot.restitution = Math.min(1, Math.max(0, contact.getRestitution()));
        spot.point = a.isRound || b.isRound ? 0 : byPlace;
        for (let i = 0, from = at + 3; i < count; ++i) {
            spot.x = numbers[from++];
            spot.y = numbers[from++];
            spot.approach = numbers[from++];
            spot.alongA = numbers[from++];
            spot.alongB = numbers[from++];
            const gap = numbers[from++];
            // Continuous collision stops bodies where they overlap by a little: they met before.
            spot.fraction = alpha > 0 ? Math.max(0, Math.min(1, alpha + (gap < 0 && spot.approach > 0 ? gap / spot.approach / this.#seconds : 0))) : leftOut;
            spot.gap = alpha > 0 ? leftOut : gap;
            spot.impulse = (contact.v_points?.[i].normalImpulse ?? impulse.normalImpulses[i]) * unit - load / count; // its own list is made anew at each look
            this.journal.touch(a.id, b.id, spot);
        }
        look.isNew = false;
    };
}

/** `world`: Planck's. A body is felt as a whole, whichever of its fixtures touches. */
export function attach(physvib, world, options = {}) {
    expectEngine(world?.getBodyList && world.on, "Planck's world", world);
    return new PlanckHaptics(physvib, world, options);
}
