// SPDX-License-Identifier: MIT
// Planck 1: Box2D 2.4 in JavaScript. Its impulses are whole; in the first phase of a step those of a new pair have gravity's share in them.
import { expectEngine, Haptics, motionAt } from './haptics.js';

const listed = first => {
    const all = [];
    for (let each = first; each; each = each.getNext()) all.push(each);
    return all;
};

class PlanckHaptics extends Haptics {
    #engine; #handlers; #seconds = 0; #gravity = { x: 0, y: 0 }; #isStepping = false; #new = new Set(); #looks = new Map();

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
        this.finish();
    }

    #observe(known, isRound, falls) {
        const { body } = known, unit = this.metresPerUnit, at = body.getWorldCenter(), v = body.getLinearVelocity(), pull = falls && body.isDynamic() ? this.#seconds * body.getGravityScale() : 0;
        known.isRound = isRound;
        this.move(known, at.x * unit, at.y * unit, v.x * unit + pull * this.#gravity.x, v.y * unit + pull * this.#gravity.y, body.getAngularVelocity());
    }

    // Continuous collision looks again, within the step: gravity is in the speeds then.
    #look(contact) {
        const fixtures = [contact.getFixtureA(), contact.getFixtureB()], bodies = fixtures.map(fixture => fixture.getBody()), unit = this.metresPerUnit;
        if (fixtures.some(fixture => fixture.isSensor())) return;
        const alpha = Math.max(...bodies.map(body => body.m_sweep?.alpha0 ?? 0)), [a, b] = bodies.map(body => this.know(body));
        [a, b].forEach((known, i) => this.#observe(known, fixtures[i].getType() === 'circle', alpha === 0));
        const { normal, points, separations } = contact.getWorldManifold();
        const meet = points.slice(0, contact.getManifold().pointCount).map((point, i) => ({ x: point.x * unit, y: point.y * unit, normalX: normal.x, normalY: normal.y,
            ...motionAt(a, b, point.x * unit, point.y * unit, normal.x, normal.y), ...(alpha > 0 ? { fraction: Math.min(1, alpha) } : { gap: (separations[i] ?? 0) * unit, gapFraction: 0 }) }));
        this.#looks.set(contact, { a, b, normal, alpha, meet });
    }

    #push(contact, { normalImpulses }) {
        const look = this.#looks.get(contact);
        if (look === undefined || !this.#isStepping) return;
        const { a, b, normal, alpha, meet } = look, unit = this.metresPerUnit;
        const pull = this.#seconds * (this.#gravity.x * normal.x + this.#gravity.y * normal.y), isOne = a.isStatic !== b.isStatic;
        const load = this.#new.has(contact) && alpha === 0 && isOne ? Math.max(0, a.isStatic ? -pull * b.massKg * b.gravityScale : pull * a.massKg * a.gravityScale) : 0;
        meet.forEach((point, i) => this.journal.touch(a.id, b.id, { ...point, impulse: normalImpulses[i] * unit - load / meet.length,
            restitution: Math.min(1, Math.max(0, contact.getRestitution())), point: a.isRound || b.isRound ? 0 : 'place' }));
        this.#new.delete(contact);
    }
}

/** `world`: Planck's. A body is felt as a whole, whichever of its fixtures touches. */
export function attach(physvib, world, options = {}) {
    expectEngine(world?.getBodyList && world.on, "Planck's world", world);
    return new PlanckHaptics(physvib, world, options);
}
