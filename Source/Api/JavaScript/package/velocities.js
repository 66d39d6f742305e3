// SPDX-License-Identifier: MIT
// Attaches to engines with velocities and boxes, but without impulses and maybe without contacts: Phaser's Arcade, Excalibur, Kaplay, or a game's own. If boxes or circles of
// two bodies meet, the change of their velocities in a step is their impact, weighted by masses. A change without a neighbour, such as a jump, is no impact.
import { apart, between, copy, eachNear, putWalls, skin, stateOf } from './boxes.js';
import { expectThat } from './explanation.js';
import { PhysVibError } from './module.js';
import { expectEngine, Haptics, motionAt } from './haptics.js';
import { contactOf, leftOut } from './journal.js';

const none = {}, members = ['bodies', 'read', 'gravity', 'bounds', 'bodyOf', 'tells'];

const pairOf = (a, b) => Math.min(a, b) * 2 ** 26 + Math.max(a, b);

class VelocityHaptics extends Haptics {
    #engine; #turn; #there = new Map(); #order = []; #turns = 0; #told = []; #walls = [{}, {}, {}, {}]; #seconds = 0; #slow = 0.15; #was = new Set(); #touching = new Set(); #before = {}; #after = {}; #spot = Object.assign(contactOf(), { gapFraction: 0 });

    constructor(physvib, engine, { metresPerUnit = 0.01, yDown = true, fieldHeight, fieldWidth = 1, fieldY, ...settings }) {
        const height = fieldHeight ?? fieldWidth;
        super(physvib, {
            bodyOf: thing => { const body = engine.bodyOf ? engine.bodyOf(thing) : thing; return body !== null && typeof body === 'object' ? body : undefined; },
            keyOf: body => body, massesOf: body => { const { massKg, gravityScale } = this.#there.get(body) ?? this.#read(body, this.#newState(body)); return { massKg, inertia: 0, gravityScale }; },
            options: ['yDown'], isThere: body => this.#there.has(body), bodies: () => this.#there.keys(), look: () => ({ filters: [] }),
        }, { metresPerUnit, fieldWidth, fieldHeight: height, fieldY: yDown ? -(fieldY ?? height) : fieldY, ...settings });
        this.#engine = engine;
        this.#turn = yDown ? -1 : 1;
        this.look();
    }

    #newState(body) {
        const state = stateOf(), given = {};
        if (!this.#walls.includes(body)) {
            // Throws, as for an object without a body: the caller that sets it shall know.
            try { this.#engine.read(body, given); } catch (error) { throw new PhysVibError(-2, `body: expected one of the engine's, found ${body.constructor?.name} (read: ${error.message})`); }
            for (const name of ['x', 'y', 'vx', 'vy']) if (typeof given[name] !== 'number') throw new PhysVibError(-2, `attachVelocities: expected that read gives x, y, vx and vy, found ${name}: ${given[name]}`);
        }
        state.body = body;
        return state;
    }
    // In metres, y upwards.
    #read(body, state) {
        const unit = this.metresPerUnit, turn = unit * this.#turn;
        state.width = state.height = state.radius = state.spin = 0;
        state.massKg = state.gravityScale = 1;
        if (this.#engine.bounds && this.#walls.includes(body)) Object.assign(state, body, { vx: 0, vy: 0, massKg: 0 });
        else this.#engine.read(body, state);
        state.x *= unit; state.y *= turn; state.vx *= unit; state.vy *= turn; state.spin *= this.#turn;
        state.radius *= unit;
        state.halfWidth = state.radius || state.width * unit / 2;
        state.halfHeight = state.radius || state.height * unit / 2;
        return state;
    }

    /** Where bodies are, and how fast, before a step: call it behind what the game itself does to velocities. Left out, the last update is what was before. */
    look() {
        this.guarded(() => {
            this.#lookAtAll();
            for (const state of this.#order) copy(state, state.before);
        });
    }
    // With the sides of bounds as bodies.
    #all() {
        const bounds = this.#engine.bounds?.();
        if (!bounds) return this.#engine.bodies();
        putWalls(this.#walls, bounds);
        return [...this.#engine.bodies(), ...this.#walls];
    }
    #lookAtAll() {
        const there = this.#there, turn = ++this.#turns;
        for (const body of this.#all()) {
            let state = there.get(body);
            if (state !== undefined) this.#read(body, state);
            else {
                state = this.#newState(body);
                state.before = stateOf();
                copy(this.#read(body, state), state.before);
                there.set(body, state);
                this.#order.push(state);
            }
            state.turn = turn;
        }
        if (this.#order.every(state => state.turn === turn)) return;
        this.#order = this.#order.filter(state => state.turn === turn || (there.delete(state.body), false));
    }

    /** Two bodies have touched in this step: for engines that tell; any pair of which this is said replaces what boxes say. `normal`: { x, y } of length 1 from a to b. */
    touch(a, b, { normal, x, y } = {}) { this.#told.push({ a: this.engine.bodyOf(a), b: this.engine.bodyOf(b), normal, x, y }); }

    /** The engine has made a step of so many seconds. */
    update(seconds) {
        this.guarded(() => this.#observe(seconds));
        this.finish();
    }
    /** `advance` makes the engine's step. */
    step(seconds, advance) {
        this.look();
        advance(seconds);
        this.update(seconds);
    }

    #observe(seconds) {
        const { gravity } = this.#engine, { x = 0, y = 0 } = (typeof gravity === 'function' ? gravity() : gravity) ?? {}, unit = this.metresPerUnit, gx = x * unit, gy = y * unit * this.#turn;
        this.#lookAtAll();
        for (const { body } of this.#order) this.know(body);
        this.begin(seconds, Math.hypot(gx, gy));
        this.#seconds = seconds;
        this.#slow = Math.max(0.15, 1.25 * seconds * Math.hypot(gx, gy));
        for (const known of this.each()) {
            const after = this.#there.get(known.body), { before } = after, falls = known.isStatic ? 0 : seconds * after.gravityScale;
            known.isRound = after.radius > 0;
            this.move(known, before.x, before.y, before.vx + falls * gx, before.vy + falls * gy, before.spin);
            if (!known.isStatic) this.journal.moved(known.id, after.vx, after.vy, after.spin);
        }
        [this.#was, this.#touching] = [this.#touching, this.#was];
        this.#touching.clear();
        if (this.#engine.tells) for (const pair of this.#told) this.#pair(this.#there.get(pair.a), this.#there.get(pair.b), pair);
        else eachNear(this.#order, (a, b) => this.#pair(a, b));
        this.#told.length = 0;
        for (const state of this.#order) copy(state, state.before);
    }

    #pair(stateA, stateB, { normal, x, y } = none) {
        if (!stateA || !stateB || !(stateA.massKg > 0 || stateB.massKg > 0)) return;
        const a = this.known(stateA.body) ?? this.know(stateA.body), b = this.known(stateB.body) ?? this.know(stateB.body), before = apart(stateA.before, stateB.before, this.#before), after = apart(stateA, stateB, this.#after);
        const unit = this.metresPerUnit, { nx, ny } = normal ? { nx: normal.x, ny: normal.y * this.#turn } : before.gap > 0 ? before : after;
        const closing = (a.vx - b.vx) * nx + (a.vy - b.vy) * ny, parting = (stateB.vx - stateA.vx) * nx + (stateB.vy - stateA.vy) * ny;
        // Bodies that pass by, or through, keep their velocities. An engine that solves before it moves has moved them apart again.
        const isMet = parting + closing > 1e-3 && Math.min(before.gap, after.gap) < skin + this.#seconds * Math.max(0, closing, parting), key = pairOf(a.id, b.id);
        if (!normal && !isMet && !(this.#was.has(key) && Math.min(before.gap, after.gap) < skin && Math.abs(closing) < this.#slow)) return; // what hops, flies
        this.#touching.add(key);
        const place = x === undefined ? between(stateA, stateB, nx, ny) : { x: x * unit, y: y * unit * this.#turn }, spot = motionAt(a, b, place.x, place.y, nx, ny, this.#spot);
        spot.x = place.x;
        spot.y = place.y;
        spot.normalX = nx;
        spot.normalY = ny;
        spot.gap = Math.max(0, before.gap);
        spot.approach = leftOut;
        this.journal.touch(a.id, b.id, spot);
    }
}

/** `engine`: { bodies(), read(body, to), gravity, bounds, bodyOf, tells }; see velocities.d.ts. */
export function attachVelocities(physvib, engine, options = {}) {
    expectEngine(typeof engine?.bodies === 'function' && typeof engine.read === 'function', 'functions bodies and read', engine);
    if (Object.getPrototypeOf(engine) === Object.prototype) for (const name in engine) expectThat(members.includes(name), 'attachVelocities', `members ${members.join(', ')}`, name);
    return new VelocityHaptics(physvib, engine, options);
}
