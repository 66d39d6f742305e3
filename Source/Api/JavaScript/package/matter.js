// SPDX-License-Identifier: MIT
// Attaches to Matter 0.19 and 0.20, and Phaser's. It moves first and tests for contacts then, its y points down, its velocities are pixels per millisecond here, and it
// has no impulses: they follow from masses and from velocities before and after its solver. It steps itself; its events say when.
import { expectEngine, Haptics, motionAt } from './haptics.js';
import { byPlace, contactOf, leftOut } from './journal.js';

const massesOf = unit => body => (body.isStatic || !Number.isFinite(body.mass)
    ? { massKg: 0, inertia: 0, gravityScale: 1 }
    : { massKg: body.mass, inertia: Number.isFinite(body.inertia) ? body.inertia * unit * unit : 0, gravityScale: body.ignoreGravity ? 0 : 1 });

// A part is felt as its compound, an object of Phaser as its body.
const bodyOf = thing => (thing?.type === 'body' ? thing.parent ?? thing : thing?.body?.type === 'body' ? bodyOf(thing.body) : undefined);

class MatterHaptics extends Haptics {
    #engine; #handlers; #seconds = 0; #there = new Set(); #byNumber = []; #step = 0; #meeting = []; #spot = Object.assign(contactOf(), { gapFraction: 1 });

    constructor(physvib, engine, { metresPerUnit = 0.01, fieldHeight, fieldWidth = 1, fieldY, ...settings }) {
        const height = fieldHeight ?? fieldWidth;
        super(physvib, { bodyOf, keyOf: body => body, massesOf: massesOf(metresPerUnit), isThere: body => this.#there.has(body), bodies: () => this.#bodies(),
            look: body => ({ isSensor: body.isSensor, isAsleep: body.isSleeping, filters: [body.collisionFilter] }) },
            { metresPerUnit, fieldWidth, fieldHeight: height, fieldY: -(fieldY ?? height), ...settings });
        this.#engine = engine;
        this.#handlers = { beforeUpdate: event => this.guarded(() => this.#begin(event)), beforeSolve: () => this.guarded(() => this.#look()), afterUpdate: () => this.finish(() => this.#end()) };
        const events = engine.events ??= {};
        for (const [name, handler] of Object.entries(this.#handlers)) events[name] = [...events[name] ?? [], handler];
    }
    // Events.off(engine), and a scene of Phaser that ends, leave none of its events.
    detach() {
        const { events } = this.#engine;
        for (const [name, handler] of Object.entries(this.#handlers)) if (events?.[name]) events[name] = events[name].filter(other => other !== handler);
    }
    hint() { return this.#engine.events?.afterUpdate?.includes(this.#handlers.afterUpdate) ? '' : "Matter's events no longer reach these haptics (Events.off, or the scene has ended): attach anew."; }

    /** Matter's events do the work. */
    step(seconds, advance) { advance(seconds); }

    #bodies(composite = this.#engine.world, all = new Set()) {
        for (const body of composite.bodies) all.add(body);
        for (const inner of composite.composites) this.#bodies(inner, all);
        return all;
    }

    // Reads the present motion of a body into one object that all calls share.
    #state = { vx: 0.5, vy: 0.5, spin: 0.5 };
    #stateOf(body) {
        const unit = this.metresPerUnit, perSecond = 1000 / (body.deltaTime || 1000 / 60), state = this.#state, { position, positionPrev } = body;
        state.vx = (position.x - positionPrev.x) * unit * perSecond;
        state.vy = -(position.y - positionPrev.y) * unit * perSecond;
        state.spin = -(body.angle - body.anglePrev) * perSecond;
        return state;
    }

    #begin({ delta }) {
        const { gravity, timing } = this.#engine;
        this.#seconds = (delta ?? timing.lastDelta) / 1000;
        this.#there = this.#bodies();
        ++this.#step;
        for (const body of this.#there) if (!body.isSensor) this.#knownOf(body).step = this.#step; // what it will touch, too
        this.begin(this.#seconds, this.#pull(gravity));
        for (const known of this.each()) this.#moveAs(known, known.body.ignoreGravity ? 0 : this.#seconds);
    }
    // Numbers of bodies are small in Matter, and a look into a list is faster than one into a map: there are thousands a step.
    #knownOf(body) {
        const known = this.#byNumber[body.id];
        return known?.body === body && !known.isOut ? known : this.#byNumber[body.id] = this.know(body);
    }
    #isThere(body) {
        const known = this.#byNumber[body.id];
        return (known?.body === body && known.step === this.#step) || this.#there.has(body);
    }
    /** What has left the world is kept by nobody. */
    left({ body }) { if (this.#byNumber[body.id]?.body === body) this.#byNumber[body.id] = undefined; }
    #pull({ x, y, scale }) { return Math.abs(Math.hypot(x, y) * scale) * 1e6 * this.metresPerUnit; }

    // The effect of Matter's damping in a step is ignored where it does not say when it solves.
    #moveAs(known, falls) {
        const { body } = known, { gravity } = this.#engine, unit = this.metresPerUnit, add = falls * gravity.scale * 1e6 * unit, moves = !known.isStatic && !body.isSleeping, { vx, vy, spin } = this.#stateOf(body);
        known.isRound = body.circleRadius > 0;
        this.move(known, body.position.x * unit, -body.position.y * unit, moves ? vx + add * gravity.x : 0, moves ? vy - add * gravity.y : 0, moves ? spin : 0);
    }

    #look() {
        for (const known of this.each()) this.#moveAs(known, 0);
    }

    #end() {
        const { list } = this.#engine.pairs, meeting = this.#meeting;
        let count = 0;
        for (const pair of list) {
            const { isActive, isSensor, collision: { parentA, parentB } } = pair;
            if (!isActive || isSensor || !this.#isThere(parentA) || !this.#isThere(parentB)) continue; // pairs outlive a world that was cleared
            meeting[count++] = pair;
            meeting[count++] = this.#knownOf(parentA);
            meeting[count++] = this.#knownOf(parentB);
        }
        for (const known of this.each()) {
            if (known.isStatic) continue;
            const { vx, vy, spin } = this.#stateOf(known.body);
            this.journal.moved(known.id, vx, vy, spin);
        }
        for (let i = 0; i < count; i += 3) if (!(meeting[i + 1].isStatic && meeting[i + 2].isStatic)) this.#touch(meeting[i], meeting[i + 1], meeting[i + 2]);
        meeting.length = count;
    }

    #touch(pair, a, b) {
        const unit = this.metresPerUnit, spot = this.#spot, { normal, depth } = pair.collision, isRound = a.isRound || b.isRound;
        const contacts = pair.activeContacts ?? pair.contacts, all = pair.activeContacts ? contacts.length : pair.contactCount, count = isRound ? Math.min(1, all) : all;
        spot.normalX = -normal.x;
        spot.normalY = normal.y;
        spot.restitution = Math.min(1, Math.max(0, pair.restitution));
        spot.gap = -depth * unit;
        spot.point = isRound ? 0 : byPlace;
        for (let i = 0; i < count; ++i) {
            const { vertex } = contacts[i], round = a.isRound ? a : b, way = (a.isRound ? 1 : -1) * (round.body.circleRadius ?? 0) * unit; // its circles are polygons
            spot.x = isRound ? round.x + way * spot.normalX : vertex.x * unit;
            spot.y = isRound ? round.y + way * spot.normalY : -vertex.y * unit;
            motionAt(a, b, spot.x, spot.y, spot.normalX, spot.normalY, spot);
            spot.approach = leftOut;
            this.journal.touch(a.id, b.id, spot);
        }
    }
}

/** `engine`: Matter's, or Phaser's `this.matter.world.engine`. Lengths of `options` are metres; the field's corner is (0, fieldHeight): a canvas' lower left. */
export function attach(physvib, engine, options = {}) {
    expectEngine(engine?.world && engine.pairs && engine.timing, "Matter's engine (Engine.create(), or Phaser's this.matter.world.engine)", engine);
    return new MatterHaptics(physvib, engine, options);
}
