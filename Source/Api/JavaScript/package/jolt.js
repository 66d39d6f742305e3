// SPDX-License-Identifier: MIT
// Attaches to Jolt (jolt-physics). Its contact listener reports possible contacts before the solver, and no impulses. The game's own listener is called, too.
import { expectEngine } from './haptics.js';
import { SpaceHaptics } from './reader.js';
import { dot, plus } from './space.js';
import { aroundSteps } from './steps.js';

const xyz = v => ({ x: v.GetX(), y: v.GetY(), z: v.GetZ() }); // it gives the same object again and again

// A system has one listener: ours, for all attachments, and a game's, whenever it has been set, behind it.
class Ears {
    #Jolt; #system; #others = null; #listener; #users = new Set();
    constructor(Jolt, system) {
        const listener = this.#listener = new Jolt.ContactListenerJS();
        this.#Jolt = Jolt;
        this.#system = system;
        listener.OnContactValidate = (...given) => this.#others?.OnContactValidate?.(...given) ?? Jolt.ValidateResult_AcceptAllContactsForThisBodyPair;
        for (const name of ['OnContactAdded', 'OnContactPersisted']) listener[name] = (...given) => {
            this.#others?.[name]?.(...given);
            for (const user of this.#users) user.touched(...given);
        };
        listener.OnContactRemoved = (...given) => this.#others?.OnContactRemoved?.(...given);
    }
    /** The game's, if it has set one; undefined: ours is set. */
    #set() {
        const Jolt = this.#Jolt, set = this.#system.GetContactListener(), at = set === null ? 0 : Jolt.getPointer(set);
        return at === Jolt.getPointer(this.#listener) ? undefined : at === 0 ? null : Jolt.castObject(set, Jolt.ContactListenerJS);
    }
    listen(user) {
        const set = this.#set();
        this.#users.add(user);
        if (set === undefined) return;
        this.#others = set;
        this.#system.SetContactListener(this.#listener);
    }
    leave(user) {
        this.#users.delete(user);
        if (this.#users.size === 0 && this.#set() === undefined) this.#system.SetContactListener(this.#others);
    }
}
const earsOf = new WeakMap();

class JoltHaptics extends SpaceHaptics {
    #Jolt; #system; #lock; #list; #handles = new Map(); #contacts = []; #ears; #end;

    constructor(physvib, { Jolt, interface: jolt }, options) {
        const system = jolt.GetPhysicsSystem(), bodies = system.GetBodyInterface();
        super(physvib, {
            looksAhead: true, bodies: () => this.#all(), isThere: ({ ID }) => bodies.IsAdded(ID), gravity: () => xyz(system.GetGravity()),
            // Memory of a body that has gone is another's: it is known by its number.
            bodyOf: thing => (thing?.ID ? thing : thing?.GetID ? this.#handleOf(thing.GetID()) : thing?.GetIndexAndSequenceNumber ? this.#handleOf(thing) : undefined), keyOf: handle => handle.number,
            massesOf: ({ ID, body }) => (bodies.IsAdded(ID) && body.IsDynamic() ? { massKg: 1 / body.GetMotionProperties().GetInverseMass(), inertia: 0, gravityScale: body.GetMotionProperties().GetGravityFactor() } : { massKg: 0, inertia: 0, gravityScale: 1 }),
            look: ({ body }) => ({ isSensor: body.IsSensor(), isAsleep: body.IsDynamic() && !body.IsActive(), filters: [] }),
            read({ body }, to) {
                to.at = xyz(body.GetCenterOfMassPosition());
                to.v = xyz(body.GetLinearVelocity());
                to.turns = xyz(body.GetAngularVelocity());
                to.isAsleep = !body.IsActive();
                if (!body.IsDynamic()) return;
                const inverse = body.GetInverseInertia(), x = xyz(inverse.GetAxisX()), y = xyz(inverse.GetAxisY()), z = xyz(inverse.GetAxisZ());
                to.inverse = [x.x, y.y, z.z, x.y, x.z, y.z];
            },
            contacts: tell => { for (const { a, b, at, normal, gap, restitution } of this.#contacts) tell(a, b, at, normal, gap, restitution, system.GetPhysicsSettings().mMinVelocityForRestitution); },
            advance: seconds => jolt.Step(seconds, 1),
        }, options);
        this.#Jolt = Jolt;
        this.#system = system;
        this.#lock = system.GetBodyLockInterfaceNoLock();
        this.#list = new Jolt.BodyIDVector();
        if (!earsOf.has(jolt)) earsOf.set(jolt, new Ears(Jolt, system));
        this.#ears = earsOf.get(jolt);
        this.#end = aroundSteps(jolt, 'Step', this, seconds => seconds);
    }
    before(seconds) {
        this.#contacts.length = 0;
        this.guarded(() => this.#ears.listen(this));
        super.before(seconds);
    }

    #handleOf(id) {
        const number = id.GetIndexAndSequenceNumber(), known = this.#handles.get(number);
        if (known !== undefined) return known;
        const ID = new this.#Jolt.BodyID(number), handle = { number, ID, body: this.#lock.TryGetBody(ID) };
        this.#handles.set(number, handle);
        return handle;
    }
    #all() {
        const list = this.#list, there = [], made = new Set();
        this.#system.GetBodies(list);
        for (let i = 0, count = list.size(); i < count; ++i) {
            const handle = this.#handleOf(list.at(i));
            made.add(handle.number);
            if (this.engine.isThere(handle)) there.push(handle);
        }
        for (const [number, { ID }] of this.#handles) {
            if (made.has(number)) continue;
            this.#handles.delete(number);
            this.#Jolt.destroy(ID);
        }
        return there;
    }

    touched(...given) { this.guarded(() => this.#look(...given)); }
    #look(first, second, manifoldAt, settingsAt) {
        const Jolt = this.#Jolt, settings = Jolt.wrapPointer(settingsAt, Jolt.ContactSettings);
        if (settings.mIsSensor) return;
        const [a, b] = [first, second].map(at => this.#handleOf(Jolt.wrapPointer(at, Jolt.Body).GetID())), manifold = Jolt.wrapPointer(manifoldAt, Jolt.ContactManifold), normal = xyz(manifold.mWorldSpaceNormal);
        for (let i = 0, count = manifold.mRelativeContactPointsOn1.size(); i < count; ++i) {
            const at = xyz(manifold.GetWorldSpaceContactPointOn1(i));
            this.#contacts.push({ a, b, at, normal, gap: dot(plus(xyz(manifold.GetWorldSpaceContactPointOn2(i)), at, -1), normal), restitution: settings.mCombinedRestitution });
        }
    }
    detach() {
        this.#end();
        this.#ears.leave(this);
    }
}

/** `engine`: { Jolt, interface }: the module, and a JoltInterface, by one collision step at a time. Bodies are Jolt's, or their BodyIDs. Who steps it, steps it still. */
export function attach(physvib, engine, options = {}) {
    expectEngine(engine?.Jolt?.BodyID && engine.interface?.GetPhysicsSystem, '{ Jolt, interface: a JoltInterface }', engine);
    return new JoltHaptics(physvib, engine, options);
}
