// SPDX-License-Identifier: MIT
// Base of all attachments: numbers of bodies, steps, and events for listeners and outputs. Inside, lengths are metres and y points up.
import { expectLibrary, expectThat, naming } from './explanation.js';
import { material } from './impact.js';
import { Journal, leftOut } from './journal.js';
import { PhysVibError } from './module.js';

const mostKept = 10000; // events that nobody takes
const wrongArgument = -2; // PHYSVIB_ERROR_ARGUMENT

// The rule by which Box2D and Matter decide.
const mayTouch = (a, b) => (a.group === b.group && a.group !== 0 ? a.group > 0 : (a.mask & b.category) !== 0 && (a.category & b.mask) !== 0);

export class Haptics {
    #known = new Map(); #away = new WeakMap(); #lastAway = null; #next = 0; #followers = new Set(); #waiting = []; #held = []; #startNs = 0; #journal = new Journal(); #isFree = false; #isInStep = false; #unsound = null; #unfollowed = null;
    /** Events that nobody took, and that have made room for newer ones. */
    forgotten = 0;
    /** What ended haptics; null: nothing did. The game goes on without them. */
    error = null;
    /** Those of physvib/audio that follow: explain() looks at the first. */
    outputs = new Set();

    /** `engine`: what tells of bodies: bodyOf(thing) (that it is, or is part of; undefined: none), keyOf(body), massesOf(body), isThere(body); to explain silence,
     * look(body) (isEnabled, isSensor, isAsleep, and filters of category, mask and group) and bodies(). */
    constructor(physvib, engine, { metresPerUnit = 1, ...settings } = {}) {
        expectLibrary('attach', physvib);
        expectThat(metresPerUnit > 0, 'metresPerUnit', 'a number above 0', metresPerUnit);
        this.engine = engine;
        this.metresPerUnit = metresPerUnit;
        // Errors of a call are thrown to the caller; only a lack of room for another world does not end a game.
        this.world = this.#made(() => naming(['metresPerUnit', ...engine.options ?? []].join(', '), () => physvib.world(settings)));
    }
    #made(make) {
        try { return make(); } catch (error) {
            if (error.code === wrongArgument) throw error;
            this.#end(error);
            return null;
        }
    }
    #end(error) {
        this.error = error;
        console.error(`PhysVib: haptics have ended, the game goes on: ${error.message}`);
    }

    /** Work of the attachment's own. What it throws ends haptics, is told once, and does not reach the game. `isCalled`: the game has called it, so a wrong argument is
     * thrown; and so is the use of what was freed. */
    guarded(work, isCalled = false, ...given) {
        if (this.error || (this.#isFree && !isCalled)) return undefined;
        try {
            return work(...given);
        } catch (error) {
            if (isCalled && (this.#isFree || error.code === wrongArgument)) throw error;
            try { this.detach?.(); } catch { /* the engine is in no state for it */ }
            this.#end(error);
            return undefined;
        }
    }

    /** How a body feels and sounds: { frequencyHz, decayPerSecond, isSource, ... }, or { material: a name }; its masses are the engine's. Its number in events, which it keeps when it leaves
     * the engine's world and comes back. */
    set(body, values = {}) {
        return this.guarded(() => {
            const known = this.know(body);
            const before = known.values, { material: name, ...own } = values;
            Object.assign(known, { values: name === undefined ? values : { ...material(name), ...own }, isGone: false });
            try {
                this.#tell(known, this.engine.massesOf(known.body));
            } catch (error) {
                known.values = before;
                throw error;
            }
            return known.id;
        }, true) ?? -1;
    }

    /** The number of a body in events; -1: haptics have ended. */
    id(body) { return this.guarded(() => this.know(body).id, true) ?? -1; }

    #bodyOf(thing) {
        const body = this.engine.bodyOf(thing);
        if (body === undefined) throw new PhysVibError(-2, `body: expected one of the engine's, found ${thing?.constructor?.name ?? String(thing)}`);
        return body;
    }

    /** A body that is to be felt no more, from the next step on. One that leaves the engine's world need not be named. */
    remove(thing) {
        this.guarded(() => {
            const body = this.#bodyOf(thing), known = this.#known.get(this.engine.keyOf(body));
            if (known !== undefined) known.isGone = true;
            this.#away.delete(body);
        }, true);
    }

    /** What is known of a body; a body that has not been set gets a number when it first touches. */
    know(thing) {
        const body = this.#bodyOf(thing), key = this.engine.keyOf(body);
        let known = this.#known.get(key);
        if (known === undefined) {
            const masses = this.engine.massesOf(body), { id = this.#next++, values = {} } = this.#away.get(body) ?? {};
            known = { id, body, values, isStatic: true, isGone: false, isRound: false, isAtRest: false, isOut: false, step: 0, massKg: 0, inertia: 0, gravityScale: 1, x: 0.5, y: 0.5, vx: 0.5, vy: 0.5, spin: 0.5 }; // fractions: engines keep such members without allocating
            known.x = known.y = known.vx = known.vy = known.spin = 0;
            this.#tell(known, masses);
            this.#known.set(key, known);
            this.#away.delete(body);
        }
        return known;
    }

    /** What is known of a body already, or undefined. */
    known(body) { return this.#known.get(this.engine.keyOf(body)); }

    // Masses may change while a game runs.
    #tell(known, masses) {
        this.#observed();
        Object.assign(known, { massKg: masses.massKg, inertia: masses.inertia, gravityScale: masses.gravityScale, isStatic: !(masses.massKg > 0) });
        const isSound = masses.massKg >= 0 && masses.massKg < Infinity && masses.inertia >= 0 && masses.inertia < Infinity && Number.isFinite(masses.gravityScale);
        if (!isSound) this.#leftOut(known.id, `mass ${masses.massKg} kg, inertia ${masses.inertia} kg m2`);
        this.world.setBody(known.id, { ...known.values, ...(isSound ? masses : { massKg: 0, inertia: 0, gravityScale: 1 }) });
    }
    // A body with numbers that are none is left out as long as it has them.
    #leftOut(id, found) { this.#unsound ??= { id, found }; }

    /** All that are known. */
    each() { return this.#known.values(); }
    /** Those of them that the engine's world still has: code of the game runs within a step. */
    *eachThere() { for (const known of this.#known.values()) if (this.engine.isThere(known.body)) yield known; }

    // Between steps: those that are gone go, masses are as they are now.
    #sweep() {
        for (const [key, known] of this.#known) {
            if (known.isGone || !this.engine.isThere(known.body)) {
                this.#known.delete(key);
                known.isOut = true;
                this.left?.(known);
                this.world.removeBody(known.id);
                if (!known.isGone) this.#away.set(known.body, known);
                if (known.values.isSource) this.#lastAway = known.isGone ? null : known.id;
                continue;
            }
            if (known.isAtRest) continue; // its engine will say when it moves again
            const { massKg, inertia, gravityScale } = this.engine.massesOf(known.body);
            if (!(massKg === known.massKg && inertia === known.inertia && gravityScale === known.gravityScale) && !(Object.is(massKg, known.massKg) && Object.is(inertia, known.inertia) && Object.is(gravityScale, known.gravityScale)))
                this.#tell(known, { massKg, inertia, gravityScale });
        }
    }

    /** Motion as the solver finds it. */
    move(known, x, y, vx, vy, spin) {
        known.x = x;
        known.y = y;
        known.vx = vx;
        known.vy = vy;
        known.spin = spin;
        this.#journal.move(known.id, x, y, vx, vy, spin);
    }
    /** What is observed in a step. */
    get journal() { return this.#journal; }
    #observed() {
        const numbers = this.#journal.take();
        const refused = numbers.length > 0 ? this.world.observe(numbers) : null;
        if (refused !== null) this.#leftOut(refused.body, refused.line);
    }

    /** Before the engine steps. */
    begin(seconds, gravity) {
        this.#sweep();
        this.#startNs = this.world.timeNs;
        this.world.beginStep(seconds, gravity);
        this.#isInStep = true;
    }

    /** Behind the engine's step: `look` observes what it did. */
    finish(look) {
        const events = this.guarded(() => {
            if (!this.#isInStep) return undefined;
            look?.();
            this.#observed();
            this.#isInStep = false;
            this.world.endStep();
            const taken = this.world.take(true);
            this.#settle(taken);
            if (this.#waiting.length > mostKept) this.forgotten += this.#waiting.splice(0, this.#waiting.length - mostKept).length;
            return taken;
        });
        if (events) for (const follower of this.#followers) this.#hand(events, follower);
    }
    // A caller of take() gets a list in time order: no more events can come from before this step.
    #settle(events) {
        if (events.length > 0) this.#held = this.#held.concat(events).sort((a, b) => a.timeNs - b.timeNs || a.fixture - b.fixture);
        while (this.#held[0]?.timeNs < this.#startNs) this.#waiting.push(this.#held.shift());
    }
    // A follower is called within the engine's step: what it throws ends it alone.
    #hand(events, follower) {
        try {
            follower(events, this.world);
        } catch (error) {
            this.#followers.delete(follower);
            this.#unfollowed ??= error;
            console.error(`PhysVib: a follower has ended, the game goes on: ${error?.message ?? error}`);
        }
    }

    /** A step that `advance` makes of the engine, between two looks at it. */
    around(advance, before, after) {
        this.guarded(before);
        let isDone = false;
        try {
            advance();
            isDone = true;
        } finally {
            this.finish(isDone ? after : undefined);
        }
    }

    /** `follower(events, world)` after each step, with all that is known; what it returns ends that. */
    follow(follower) {
        this.#followers.add(follower);
        return () => this.#followers.delete(follower);
    }

    /** Events since the last take: final ones, a step late; or, `atOnce`, all. */
    take(atOnce = false) {
        return [...this.#waiting.splice(0), ...this.#held.splice(0, atOnce ? Infinity : 0)];
    }

    /** Why nothing is felt of what happened since the last call; see World.explain. */
    explain(output = [...this.outputs][0]) {
        const why = this.guarded(() => this.#explained(output), true);
        return this.error ? `Haptics have ended by an error: ${this.error.message}. Free these, and those of scenes that have ended (free()), and attach anew.` : why;
    }
    #explained(output) {
        for (const known of this.#known.values()) {
            const note = known.values.isSource && !known.isGone ? this.#noteOf(known.body) : undefined;
            if (note !== undefined) this.world.note(known.id, note);
        }
        const unsound = this.#unsound, hints = [this.hint?.(), unsound && `Body ${unsound.id} is left out while the engine gives it numbers that are none (${unsound.found}).`,
            this.#unfollowed && `A follower has ended by an error: ${this.#unfollowed.message}.`];
        const said = [...hints.filter(Boolean), this.world.explain(output)].join(' ').replace(/beginStep( and endStep)?/g, 'update');
        this.#unsound = this.#unfollowed = null;
        // Two that nothing can push do not touch for an engine.
        const still = [...this.each()].filter(known => known.values.isSource), id = still.every(known => known.isStatic) ? still[0]?.id : undefined;
        if (id !== undefined && said.includes('nothing has touched')) return `Body ${id} is immovable (fixed, kinematic, or of no mass): it is felt when what can be pushed strikes it; nothing has. To be pushed, it has to be dynamic.`;
        return this.#lastAway === null || [...this.each()].some(known => known.values.isSource) ? said
            : `No haptic source is in the engine's world: body ${this.#lastAway} was not added to it, or has left it. Before: ${said}`;
    }
    #noteOf(body) {
        const { keyOf, look, bodies } = this.engine;
        if (look === undefined) return undefined;
        const { isEnabled = true, isSensor, isAsleep, filters } = look(body);
        if (!isEnabled) return 'disabled';
        if (isSensor) return 'sensor';
        const others = [...bodies()].filter(other => keyOf(other) !== keyOf(body)).flatMap(other => look(other).filters);
        if (others.length > 0 && filters.every(a => others.every(b => !mayTouch(a, b)))) return 'filtered';
        return isAsleep ? 'asleep' : undefined;
    }
    get counts() { return this.world?.counts; }

    /** Ends it: the engine is as it was. */
    free() {
        if (this.#isFree) return;
        if (!this.error) this.detach?.();
        this.#isFree = true;
        this.#followers.clear();
        this.world?.free();
    }
}

/** Of a point of contact of two known bodies, normal from a to b: how fast it closes, and how it runs along both surfaces; into `to`, which is returned. */
export function motionAt(a, b, x, y, nx, ny, to) {
    const ax = a.vx - a.spin * (y - a.y), ay = a.vy + a.spin * (x - a.x), bx = b.vx - b.spin * (y - b.y), by = b.vy + b.spin * (x - b.x);
    // The point itself goes with a round body's centre, or with the corner of what moves.
    const ux = b.isRound ? b.vx : a.isRound ? a.vx : b.isStatic ? ax : bx, uy = b.isRound ? b.vy : a.isRound ? a.vy : b.isStatic ? ay : by;
    to.approach = (ax - bx) * nx + (ay - by) * ny;
    to.alongA = (ux - ax) * -ny + (uy - ay) * nx;
    to.alongB = (ux - bx) * -ny + (uy - by) * nx;
    return to;
}

/** How fast two surfaces meet that close with `to.approach` across `to.gap`, while `pull` (m/s^2) draws them together; and when, in steps. */
export function meet(to, pull, seconds) {
    const { approach: speed, gap } = to, squared = speed * speed + 2 * pull * Math.max(0, gap), approach = to.approach = speed > 0 && squared > 0 ? Math.sqrt(squared) : speed, isAhead = gap > 0 && speed + approach > 0;
    to.fraction = isAhead ? Math.min(2, 2 * gap / (speed + approach) / seconds) : leftOut;
    to.gapFraction = isAhead ? leftOut : 0;
    if (isAhead) to.gap = leftOut;
}

export const expectEngine = (isOne, expected, found) => expectThat(isOne, 'attach', expected, found);
