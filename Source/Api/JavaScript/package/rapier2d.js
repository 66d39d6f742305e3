// SPDX-License-Identifier: MIT
// Attaches to Rapier 2D, which predicts contacts before it moves and solves in small steps. So an impact is reported by speed and restitution, and a lasting contact
// by momentum.
import { byPlace, contactOf, leftOut } from './journal.js';
import { expectEngine, Haptics, meet, motionAt } from './haptics.js';
import { aroundSteps } from './steps.js';
import { closingOf, endOf, startOf, stopOf } from './stops.js';

const nearMetres = 0.005; // what lies within goes on touching, though Rapier pushes it in some steps only

/** Whose contacts a collider's are: its body's, or its own where it has none, as a ground often has not. */
const ownerOf = collider => collider.parent() ?? collider;

// Pairs that touched in the step before: small whole numbers, which a set keeps without allocating, as long as there are few bodies.
const keyOf = (a, b) => (a < 2 ** 15 && b < 2 ** 15 ? a << 15 | b : 2 ** 53 - 1 - a * 2 ** 26 - b);

// Rapier before 0.20 does not say it of a pair: the later rule of both counts (average, least, product, most).
const combined = [(a, b) => (a + b) / 2, Math.min, (a, b) => a * b, Math.max];
const bounceOf = (a, b) => combined[Math.max(a.restitutionCombineRule(), b.restitutionCombineRule())](a.restitution(), b.restitution());

// Rapier makes an object of each pair and of each manifold that is looked at, and has the collector watch it, which costs more than what they tell. While we look, there is
// one of each.
const shared = type => {
    const { __wrap } = type, only = Object.create(type.prototype);
    only.__destroy_into_raw = () => { const at = only.__wbg_ptr; only.__wbg_ptr = 0; return at; };
    const share = at => { only.__wbg_ptr = at; return only; };
    return is => { type.__wrap = is ? share : __wrap; };
};

/** What both have; physvib/rapier3d says otherwise what space changes. */
export class RapierHaptics extends Haptics {
    #engine; #end; #touching = new Set(); #was = new Set(); #kept = new Map(); #list = []; #met = 0; #turn = 0; #share = null; #pass = 0; #seconds = 0; #fresh = null; #one = null; #other = null; #pairs = null; #slack = 0; #lastSeconds = 0; #v = undefined; #normal = undefined; #gravity = undefined;
    /** Of a contact as it is looked at. */
    spot = Object.assign(contactOf(), { soft: 1 });

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
        this.#end = aroundSteps(engine, 'step', this, () => engine.timestep);
    }
    detach() { this.#end(); }

    /** Around the world's step, whoever makes it: a game, or a component of React. */
    before(seconds) { this.guarded(() => this.#before(seconds)); }
    after(isDone) { this.finish(isDone ? () => this.#after(this.#seconds) : undefined); }
    /** `advance` calls the world's step; without it, we do. */
    step(seconds, advance = () => this.#engine.step()) {
        this.#engine.timestep = seconds;
        advance(seconds);
    }
    #before(seconds) {
        const { gravity } = this.#engine, pull = this.size(gravity) * this.metresPerUnit;
        this.#seconds = seconds;
        this.#gravity = gravity;
        this.#slack = 0.05 + pull * seconds;
        ++this.#pass;
        ++this.#turn;
        this.#engine.propagateModifiedBodyPositionsToColliders?.(); // as its step does at first: colliders are where the game has put their bodies
        this.#rest();
        this.begin(seconds, pull);
        this.#meetAll();
        for (const known of this.each()) this.#observe(known);
    }
    #observe(known) {
        if (known.isAtRest) this.observeAgain(known);
        else if (known.body.isDynamic) this.observe(known, this.#seconds * this.#fall(known) * this.metresPerUnit, this.#gravity);
        else this.observeStill(known, known.body.translation());
    }
    #after(seconds) {
        ++this.#turn;
        for (const known of this.eachThere()) {
            if (known.isStatic) continue;
            if (known.isAtRest && !known.body.isSleeping()) known.isAtRest = false; // something has woken it
            if (known.isAtRest) this.movedAgain(known);
            else this.moved(known, this.#v = known.body.linvel(this.#v), known.body.angvel());
        }
        [this.#was, this.#touching] = [this.#touching, this.#was];
        this.#touching.clear();
        this.#gravity = this.#engine.gravity;
        this.#share?.forEach(share => share(true));
        try { this.#eachPair(); } finally { this.#share?.forEach(share => share(false)); }
        const sub = seconds / (this.#engine.numSolverIterations ?? 4);
        for (const known of this.eachThere()) if (!known.isStatic && !known.isAtRest && known.stop) this.ended(known, seconds, sub); // for the next step's contacts
        this.#lastSeconds = seconds;
    }
    update(seconds) { this.step(seconds); }

    // What is known of a collider: its body, its pose before the step, and its contacts as they were observed while its body slept. `told`, `live`: the step in which it
    // told those again, or told others.
    #keptOf(collider) {
        let kept = this.#kept.get(collider);
        if (kept === undefined) this.#kept.set(collider, kept = { collider, known: null, at: undefined, turned: undefined, radius: 0.5, reach: 0.5, posed: 0, seen: 0, told: 0, live: 0, contacts: null, pairs: [], touching: [], others: [] });
        return kept;
    }
    // The same of one that is likely at that place of a list: they come in the order of the step before.
    #keptAt(list, i, collider) {
        const likely = list[i];
        return likely?.collider === collider ? likely : list[i] = this.#keptOf(collider);
    }
    #knownOf(kept) {
        if (kept.known === null || kept.known.isOut) kept.known = this.know(kept.collider);
        return kept.known;
    }
    // Each pair of colliders once, by that which is seen first.
    #eachPair() {
        const engine = this.#engine, pass = this.#pass;
        let seen = 0;
        engine.forEachCollider(one => {
            const kept = this.#keptAt(this.#list, seen, one);
            kept.seen = pass;
            ++seen;
            if (!one.parent()?.isDynamic()) return;
            const { isAtRest } = this.#knownOf(kept);
            if (isAtRest && kept.contacts !== null) {
                kept.told = pass;
                for (const key of kept.touching) this.#touching.add(key);
                this.journal.again(kept.contacts);
                return;
            }
            kept.contacts = null;
            if (one.isSensor()) return;
            const { place } = this.journal;
            this.#one = kept;
            this.#pairs = isAtRest ? [] : null;
            this.#fresh = isAtRest ? [] : null;
            this.#met = 0;
            engine.contactPairsWith(one, this.#meets);
            if (kept.others.length > this.#met) kept.others.length = this.#met;
            kept.live = pass;
            if (isAtRest) Object.assign(kept, { contacts: this.journal.copy(place), pairs: this.#pairs, touching: this.#fresh });
        });
        if (seen < this.#kept.size) for (const [collider, kept] of this.#kept) if (kept.seen !== pass) this.#kept.delete(collider);
        this.#list.length = seen;
    }
    #meets = other => {
        const one = this.#one, kept = this.#keptAt(one.others, this.#met++, other);
        if (kept.live === this.#pass || (kept.told === this.#pass && kept.pairs.includes(one)) || other.isSensor()) return;
        this.#pairs?.push(kept);
        const a = this.#knownOf(one), b = this.#knownOf(kept);
        if (a === b || this.#areApart(one, kept)) return;
        this.#other = kept;
        this.#share ??= this.#sharedOf(one.collider, other);
        this.#engine.contactPair(one.collider, other, this.#look);
    };
    #sharedOf(one, other) {
        const pair = this.#engine.narrowPhase.raw?.contact_pair?.(one.handle, other.handle), manifold = pair?.contactManifold(0), types = [pair, manifold].map(raw => raw?.constructor);
        manifold?.free();
        pair?.free();
        return manifold ? types.filter(type => type.__wrap).map(shared) : null;
    }
    // The distance of two balls says whether Rapier has tested them for contact: asking Rapier is expensive.
    #areApart(one, other) {
        return one.radius > 0 && other.radius > 0 && one.posed === this.#pass && other.posed === this.#pass && this.between(one.at, other.at) > one.radius + other.radius + one.reach + other.reach;
    }

    // A body that sleeps lies where it lay, with its masses, until something wakes it.
    #rest() {
        for (const known of this.eachThere()) {
            const isAsleep = !known.isStatic && known.body.isSleeping();
            known.isAtRest = isAsleep && known.hasSlept === true && known.posed === known.body.numColliders();
            known.hasSlept = isAsleep;
            if (known.isAtRest) continue;
            known.posed = 0;
            if (!known.isStatic) known.body.recomputeMassPropertiesFromColliders?.(); // as its step does at first: masses are what the game has made them
        }
    }
    // A body that touches for the first time is known before the step that it touches in.
    #meetAll() {
        const { integrationParameters } = this.#engine, near = integrationParameters.predictionDistance ?? integrationParameters.normalizedPredictionDistance * integrationParameters.lengthUnit, unit = this.metresPerUnit;
        let seen = 0;
        this.#engine.forEachCollider(collider => {
            const kept = this.#keptAt(this.#list, seen++, collider), owner = ownerOf(collider), known = this.#sensed(kept, owner);
            if (known?.isAtRest) {
                if (kept.posed > 0) kept.posed = this.#pass;
                return;
            }
            if (collider.isSensor()) return;
            this.#pose(kept, this.#knownOf(kept));
            kept.reach = owner.isCcdEnabled?.() || owner.softCcdPrediction?.() > 0 ? Infinity : near + collider.contactSkin() + nearMetres / unit;
        });
    }
    // The record of a collider, which is only kept for bodies that were observed: a sensor need not have one.
    #sensed({ known }, owner) {
        const found = known === null || known.isOut ? this.known(owner) : known;
        return found?.isGone ? undefined : found;
    }
    #pose(kept, known) {
        const { collider } = kept;
        known.isRound = collider.shapeType() === 0; // ShapeType.Ball
        known.posed = (known.posed ?? 0) + 1;
        kept.posed = this.#pass;
        kept.at = collider.translation(kept.at);
        if (!known.isRound) kept.turned = collider.rotation(kept.turned);
        kept.radius = known.isRound ? collider.radius() : 0;
    }

    // Once before the step, and once behind it: a body is in many contacts.
    #fall(known) {
        if (known.step !== this.#turn) {
            known.step = this.#turn;
            known.fall = known.isStatic || known.isAtRest || known.body.isSleeping() ? 0 : known.gravityScale;
        }
        return known.fall;
    }

    /** As this step will have it: Rapier derives that of what is put by its place within the step. */
    velocityOf({ isStatic, body }) {
        if (!isStatic || body.bodyType() !== 2) return this.#w = body.linvel(this.#w); // RigidBodyType.KinematicPositionBased
        const at = body.translation(), next = body.nextTranslation(), per = this.#seconds > 0 ? 1 / this.#seconds : 0;
        return { x: (next.x - at.x) * per, y: (next.y - at.y) * per, z: (next.z - at.z) * per };
    }
    inertiaOf(body) { return body.effectiveAngularInertia(); } // 0: it is kept from turning
    size({ x, y }) { return Math.hypot(x, y); }
    product(a, b) { return a.x * b.x + a.y * b.y; }
    between(a, b) { return Math.sqrt((b.x - a.x) ** 2 + (b.y - a.y) ** 2); }
    #at = undefined; #w = undefined;
    /** Motion before the step, as Rapier looks at it, and as its solver finds it, with a `pull` along gravity. */
    observe(known, pull, gravity) {
        const { body } = known, unit = this.metresPerUnit, at = this.#at = body.worldCom(this.#at), v = this.velocityOf(known);
        known.x = at.x * unit;
        known.y = at.y * unit;
        known.vx = v.x * unit;
        known.vy = v.y * unit;
        known.spin = body.angvel();
        const vx = known.vx + pull * gravity.x, vy = known.vy + pull * gravity.y;
        if (!known.isStatic) startOf(known.stop ??= stopOf(), known.x, known.y, 0, known.vx, known.vy, 0, vx, vy, 0);
        this.journal.move(known.id, known.x, known.y, vx, vy, known.spin);
    }
    ended({ stop, body, endX, endY }, seconds, subSeconds) {
        const unit = this.metresPerUnit, at = this.#at = body.worldCom(this.#at);
        endOf(stop, at.x * unit, at.y * unit, 0, endX, endY, 0, seconds, subSeconds);
    }
    /** What a body has lost at a contact, along its normal. */
    lostAt({ stop, x, y, spin }, spot) { return stop ? stop.toX * spot.normalX + stop.toY * spot.normalY + stop.turn * spin * ((spot.x - x) * spot.normalY - (spot.y - y) * spot.normalX) : 0; }
    observeAgain(known) { this.journal.move(known.id, known.x, known.y, known.vx, known.vy, known.spin); }
    movedAgain(known) { this.journal.moved(known.id, known.vx, known.vy, known.spin); }
    observeStill(known, { x, y }) { this.move(known, x * this.metresPerUnit, y * this.metresPerUnit, 0, 0, 0); }
    moved(known, { x, y }, spin) { this.journal.moved(known.id, known.endX = x * this.metresPerUnit, known.endY = y * this.metresPerUnit, spin); }
    #places = [{ x: 0.5, y: 0.5 }, { x: 0.5, y: 0.5 }]; #local = undefined;
    /** The point of a collider at its pose, k of two; the normal m goes out of the first. */
    #onSurface(k, { at, turned, radius }, m, manifold, i) {
        const place = this.#places[k];
        if (radius > 0) {
            place.x = at.x + (k ? -1 : 1) * radius * m.x;
            place.y = at.y + (k ? -1 : 1) * radius * m.y;
            return place;
        }
        const cos = Math.cos(turned), sin = Math.sin(turned), local = this.#local = k ? manifold.localContactPoint2(i, this.#local ?? undefined) : manifold.localContactPoint1(i, this.#local ?? undefined);
        place.x = at.x + cos * local.x - sin * local.y;
        place.y = at.y + sin * local.x + cos * local.y;
        return place;
    }
    // What masses do not say: who dominates cannot be pushed by the other, and what is kept from moving along an axis is heavier. Rapier's own impulse says how strong.
    #isOdd({ body: a }, { body: b }) {
        const groupOf = body => (body.isDynamic?.() ? body.dominanceGroup() : 128), isKept = body => body.isDynamic?.() && Object.values(body.effectiveInvMass()).some(part => part === 0);
        return (groupOf(a) !== groupOf(b) && groupOf(a) !== 128 && groupOf(b) !== 128) || isKept(a) || isKept(b);
    }
    /** Into `spot`: where contact i of a manifold is, across which gap, and how both surfaces run there. `first`, `second`: its colliders; m: its normal, `turn` times which
     * goes from a to b. Rapier keeps a contact's points and distance for some steps while bodies move on, so they are where both bodies have them now; a ball's are where it is nearest. */
    lookAt(manifold, i, first, second, m, turn, a, b) {
        const unit = this.metresPerUnit, spot = this.spot, one = this.#onSurface(0, first, m, manifold, i), other = this.#onSurface(1, second, m, manifold, i);
        spot.x = one.x * unit;
        spot.y = one.y * unit;
        spot.normalX = turn * m.x;
        spot.normalY = turn * m.y;
        spot.gap = ((other.x - one.x) * m.x + (other.y - one.y) * m.y) * unit;
        motionAt(a, b, spot.x, spot.y, spot.normalX, spot.normalY, spot);
    }

    #look = (manifold, isFlipped) => {
        const count = manifold.numContacts(), one = this.#one, other = this.#other, pass = this.#pass;
        if (count === 0 || one.posed !== pass || other.posed !== pass) return;
        const a = one.known, b = other.known, key = keyOf(a.id, b.id), turn = isFlipped ? -1 : 1, m = this.#normal = manifold.normal(this.#normal), unit = this.metresPerUnit, spot = this.spot, seconds = this.#seconds;
        let bounce = -1, isOdd = null;
        for (let i = 0; i < count; ++i) {
            const impulse = manifold.contactImpulse(i);
            if (!(impulse > 0) && !this.#was.has(key)) continue; // near, and not yet there
            this.lookAt(manifold, i, isFlipped ? other : one, isFlipped ? one : other, m, turn, a, b);
            if (!(impulse > 0) && !(spot.gap < nearMetres && Math.abs(spot.approach) < this.#slack)) continue;
            if (spot.gap > nearMetres + (this.#slack + Math.max(0, spot.approach)) * seconds) continue; // Rapier keeps impulses of pairs that touch no more
            if (bounce < 0) bounce = Math.min(1, Math.max(0, manifold.restitution?.() ?? bounceOf(one.collider, other.collider)));
            this.#touching.add(key);
            this.#fresh?.push(key);
            spot.impulse = Math.max(0, impulse * unit);
            spot.restitution = bounce;
            spot.point = a.isRound || b.isRound ? 0 : byPlace;
            const pull = (this.#fall(a) - this.#fall(b)) * turn * this.product(this.#gravity, m) * unit, isPut = a.stop?.isPut || b.stop?.isPut, gap = spot.gap + (isPut ? 0 : Math.min(0, this.lostAt(b, spot) - this.lostAt(a, spot))), speed = spot.approach;
            meet(spot, pull, seconds);
            if (gap < 0 && speed > 0) {
                spot.fraction = isPut ? 0 : closingOf(gap, speed, pull, seconds, this.#lastSeconds, seconds / (this.#engine.numSolverIterations ?? 4));
                spot.gap = leftOut;
            }
            isOdd ??= !this.#was.has(key) && this.#isOdd(a, b);
            spot.soft = isOdd ? leftOut : 1;
            this.journal.touch(a.id, b.id, spot);
        }
    };
}

export const expectRapier = world => expectEngine(world?.bodies && world.colliders && world.narrowPhase, "Rapier's world", world);

/** `world`: Rapier's. Values are those of a rigid body, whichever of its colliders touches. */
export function attach(physvib, world, options = {}) {
    expectRapier(world);
    return new RapierHaptics(physvib, world, options);
}
