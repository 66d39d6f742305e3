// SPDX-License-Identifier: MIT
// Planck 1: Box2D 2.4 in JavaScript. Its impulses are whole; in the first phase of a step those of a new pair have gravity's share in them.
import { expectEngine, Haptics, motionAt } from './haptics.js';

const listed = first => {
    const all = [];
    for (let each = first; each; each = each.getNext()) all.push(each);
    return all;
};

const pointOf = () => ({ x: 0.5, y: 0.5, normalX: 0.5, normalY: 0.5, approach: 0.5, alongA: 0.5, alongB: 0.5, fraction: undefined, gap: undefined, gapFraction: undefined, impulse: 0.5, restitution: 0.5, point: 0 });

class PlanckHaptics extends Haptics {
    #engine; #handlers; #seconds = 0; #gravity = { x: 0, y: 0 }; #isStepping = false; #new = new Set(); #looks = new Map(); #spare = []; #used = 0; #manifold = null;

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
            'pre-step': seconds => this.#start(seconds), 'post-step': () => this.#end(), 'begin-contact': contact => this.#new.add(contact), 'end-contact': contact => this.#new.delete(contact),
            'pre-solve': contact => this.guarded(() => this.#look(contact)), 'post-solve': (contact, impulse) => this.guarded(() => this.#push(contact, impulse)),
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
        for (const known of this.each()) this.#observe(known, known.isRound, false);
    }
    #end() {
        if (!this.#isStepping) return;
        this.#isStepping = false;
        this.#looks.clear();
        this.#used = 0;
        this.finish();
    }

    #observe(known, isRound, falls) {
        const { body } = known, unit = this.metresPerUnit, at = body.getWorldCenter(), v = body.getLinearVelocity(), pull = falls && body.isDynamic() ? this.#seconds * body.getGravityScale() : 0;
        known.isRound = isRound;
        this.move(known, at.x * unit, at.y * unit, v.x * unit + pull * this.#gravity.x, v.y * unit + pull * this.#gravity.y, body.getAngularVelocity());
    }

    // Continuous collision looks again, within the step: gravity is in the speeds then.
    #look(contact) {
        const fixtureA = contact.getFixtureA(), fixtureB = contact.getFixtureB(), bodyA = fixtureA.getBody(), bodyB = fixtureB.getBody(), unit = this.metresPerUnit;
        if (fixtureA.isSensor() || fixtureB.isSensor()) return;
        const alpha = Math.max(bodyA.m_sweep?.alpha0 ?? 0, bodyB.m_sweep?.alpha0 ?? 0), a = this.know(bodyA), b = this.know(bodyB);
        this.#observe(a, fixtureA.getType() === 'circle', alpha === 0);
        this.#observe(b, fixtureB.getType() === 'circle', alpha === 0);
        const { normal, points, separations } = this.#manifold = contact.getWorldManifold(this.#manifold), look = this.#lookOf(contact);
        look.a = a;
        look.b = b;
        look.nx = normal.x;
        look.ny = normal.y;
        look.alpha = alpha;
        look.count = contact.getManifold().pointCount;
        for (let i = 0; i < look.count; ++i) {
            const point = look.points[i], x = points[i].x * unit, y = points[i].y * unit, { approach, alongA, alongB } = motionAt(a, b, x, y, normal.x, normal.y);
            point.x = x;
            point.y = y;
            point.normalX = normal.x;
            point.normalY = normal.y;
            point.approach = approach;
            point.alongA = alongA;
            point.alongB = alongB;
            point.fraction = alpha > 0 ? Math.min(1, alpha) : undefined;
            point.gap = alpha > 0 ? undefined : (separations[i] ?? 0) * unit;
            point.gapFraction = alpha > 0 ? undefined : 0;
        }
    }
    // Of a contact in this step; those of steps before are used again.
    #lookOf(contact) {
        let look = this.#looks.get(contact);
        if (look !== undefined) return look;
        look = this.#spare[this.#used] ??= { a: null, b: null, nx: 0.5, ny: 0.5, alpha: 0.5, count: 0, points: [pointOf(), pointOf()] };
        ++this.#used;
        this.#looks.set(contact, look);
        return look;
    }

    #push(contact, { normalImpulses }) {
        const look = this.#looks.get(contact);
        if (look === undefined || !this.#isStepping) return;
        const { a, b, nx, ny, alpha, count, points } = look, unit = this.metresPerUnit;
        const pull = this.#seconds * (this.#gravity.x * nx + this.#gravity.y * ny), isOne = a.isStatic !== b.isStatic;
        const load = this.#new.has(contact) && alpha === 0 && isOne ? Math.max(0, a.isStatic ? -pull * b.massKg * b.gravityScale : pull * a.massKg * a.gravityScale) : 0;
        for (let i = 0; i < count; ++i) {
            const point = points[i];
            point.impulse = normalImpulses[i] * unit - load / count;
            point.restitution = Math.min(1, Math.max(0, contact.getRestitution()));
            point.point = a.isRound || b.isRound ? 0 : 'place';
            this.journal.touch(a.id, b.id, point);
        }
        this.#new.delete(contact);
    }
}

/** `world`: Planck's. A body is felt as a whole, whichever of its fixtures touches. */
export function attach(physvib, world, options = {}) {
    expectEngine(world?.getBodyList && world.on, "Planck's world", world);
    return new PlanckHaptics(physvib, world, options);
}
