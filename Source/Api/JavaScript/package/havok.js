// SPDX-License-Identifier: MIT
// Attaches to Havok: Babylon's scene with HavokPlugin, or the package @babylonjs/havok. It reports a bounce in three events whose impulses are not those of its steps, so
// events are only used for who touches, and where.
import { expectEngine } from './haptics.js';
import { inverseOf, SpaceHaptics } from './reader.js';
import { dot, plus, turn } from './space.js';
import { aroundSteps } from './steps.js';

const xyz = ([x, y, z]) => ({ x, y, z }), axes = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(xyz);
const numberOf = id => id?.[0]; // Babylon takes it from what it disposes of
// MaterialCombine, by its number.
const combined = [(a, b) => Math.sqrt(a * b), Math.min, Math.max, (a, b) => (a + b) / 2, (a, b) => a * b];

const attached = new Set(), last = new WeakMap(); // of a module: the events of each world's last step
/** Whoever reads events first takes them from Havok: of several that are attached, the others get the same. */
function eventsOf(hk, world) {
    const worlds = last.get(hk), events = worlds.get(numberOf(world)) ?? [];
    if (worlds.has(numberOf(world))) return events;
    for (let at = hk.HP_World_GetCollisionEvents(world)[1]; at; at = hk.HP_World_GetNextCollisionEvent(world, at)) events.push(hk.HP_Event_AsCollision(at)[1]);
    worlds.set(numberOf(world), events);
    return events;
}

class HavokHaptics extends SpaceHaptics {
    #there = new Map(); #masks = new Map(); #hk; #world; #idOf; #end;

    /** `engine`: havok (the module), world, bodies(), idOf(body), bodyOf(thing), gravity(). */
    constructor(physvib, { havok: hk, world, idOf, bodies, ...engine }, options) {
        const { DYNAMIC } = hk.MotionType, { INACTIVE } = hk.ActivationState, of = (call, id) => hk[call](id)[1];
        const isMoving = id => of('HP_Body_GetMotionType', id) === DYNAMIC, isAsleep = id => of('HP_Body_GetActivationState', id) === INACTIVE, bodyBy = id => this.#there.get(numberOf(id));
        super(physvib, {
            subSteps: 4, advance: seconds => hk.HP_World_Step(world, seconds), isThere: body => bodyBy(idOf(body)) === body,
            // A body is numbered as one before it was, which has gone: the list says which of them is there.
            bodies: () => {
                this.#there = new Map([...bodies()].map(body => [numberOf(idOf(body)), body]));
                for (const body of this.#there.values()) if (!this.#masks.has(body)) this.#listen(body);
                return this.#there.values();
            },
            massesOf(body) {
                const id = idOf(body);
                return isMoving(id) ? { massKg: of('HP_Body_GetMassProperties', id)[1], inertia: 0, gravityScale: of('HP_Body_GetGravityFactor', id) } : { massKg: 0, inertia: 0, gravityScale: 1 };
            },
            look(body) {
                const id = idOf(body), [category, mask] = of('HP_Shape_GetFilterInfo', of('HP_Body_GetShape', id));
                return { isAsleep: isAsleep(id), filters: [{ category, mask, group: 0 }] };
            },
            read(body, to) {
                const id = idOf(body), [at, [x, y, z, w]] = of('HP_Body_GetQTransform', id), turned = { x, y, z, w }, [centre, massKg, moments, [p, q, r, s]] = of('HP_Body_GetMassProperties', id);
                to.at = plus(xyz(at), turn(turned, xyz(centre)));
                to.v = xyz(of('HP_Body_GetLinearVelocity', id));
                to.turns = xyz(of('HP_Body_GetAngularVelocity', id));
                to.inverse = inverseOf(moments.map(ofOneKg => massKg * ofOneKg), axes.map(axis => turn(turned, turn({ x: p, y: q, z: r, w: s }, axis))));
                to.isAsleep = isAsleep(id);
            },
            contacts(tell) {
                const bounce = ([, , [shape]]) => of('HP_Shape_GetMaterial', shape);
                for (const [type, onA, onB] of eventsOf(hk, world)) {
                    const a = bodyBy(onA[0]), b = bodyBy(onB[0]);
                    if (!a || !b || type === hk.EventType.COLLISION_FINISHED) continue;
                    const [, , e, , how] = bounce(onA), [, , f, , also] = bounce(onB), normal = xyz(onA[4]), place = xyz(onA[3]);
                    tell(a, b, place, normal, dot(plus(xyz(onB[3]), place, -1), normal), combined[Math.max(how.value, also.value)](e, f));
                }
            },
            ...engine,
        }, options);
        this.#hk = hk;
        this.#idOf = idOf;
        attached.add(this);
        if (!last.has(hk)) last.set(hk, new Map());
        this.#world = world;
        this.#end = aroundSteps(hk, 'HP_World_Step', this, (of, seconds) => seconds, of => numberOf(of) === numberOf(world));
    }
    before(seconds) {
        last.get(this.#hk).delete(numberOf(this.#world));
        super.before(seconds);
    }
    #askedBy(body) { return [...attached].find(each => each !== this && each.#masks.has(body)); }
    // Bodies tell of contacts if they are asked to; what they were asked before anybody attached, they are asked again in the end.
    #listen(body) {
        const id = this.#idOf(body), before = this.#askedBy(body)?.#masks.get(body) ?? this.#hk.HP_Body_GetEventMask(id)[1], { COLLISION_STARTED, COLLISION_CONTINUED } = this.#hk.EventType;
        this.#masks.set(body, before);
        this.#hk.HP_Body_SetEventMask(id, before | COLLISION_STARTED.value | COLLISION_CONTINUED.value);
    }
    left({ body }) { this.#masks.delete(body); }
    detach() {
        this.#end();
        attached.delete(this);
        for (const [body, before] of this.#masks) if (this.engine.isThere(body) && !this.#askedBy(body)) this.#hk.HP_Body_SetEventMask(this.#idOf(body), before);
    }
}

// Accepts a body, a mesh that has one, or an aggregate.
const heldBy = thing => (thing?.hpBodyId ? thing : thing?._pluginData ?? thing?._pluginDataInstances?.[0] ?? (thing?.physicsBody ?? thing?.body ? heldBy(thing.physicsBody ?? thing.body) : undefined));

/** `engine`: Babylon's scene, with physics enabled; or { havok, world, bodies, gravity } of the package itself. */
export function attach(physvib, engine, options = {}) {
    if (engine?.havok) {
        const { havok, world, bodies, gravity = [0, -9.81, 0] } = engine;
        expectEngine(world && typeof bodies === 'function', 'havok, world, and a function bodies', engine);
        return new HavokHaptics(physvib, { havok, world, bodies, idOf: body => body, bodyOf: thing => (typeof thing?.[0] === 'bigint' ? thing : undefined), gravity: () => xyz(typeof gravity === 'function' ? gravity() : gravity) }, options);
    }
    const physics = engine?.getPhysicsEngine?.(), plugin = physics?.getPhysicsPlugin?.();
    expectEngine(plugin?._hknp, "Babylon's scene with HavokPlugin, or { havok, world, bodies }", engine);
    return new HavokHaptics(physvib, { havok: plugin._hknp, world: plugin.world, bodies: () => physics.getBodies().flatMap(body => (body._pluginDataInstances?.length ? body._pluginDataInstances : [body._pluginData])),
        idOf: held => held.hpBodyId, bodyOf: heldBy, gravity: () => physics.gravity }, options);
}
