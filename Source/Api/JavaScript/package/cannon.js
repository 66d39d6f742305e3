// SPDX-License-Identifier: MIT
// Attaches to cannon-es, which tests for overlaps, solves, and then moves. It steps itself; its subsystems and listeners call the code that must run within a step.
import { expectEngine } from './haptics.js';
import { SpaceHaptics } from './reader.js';
import { dot, plus } from './space.js';

const dynamic = 1, asleep = 2, ball = 1; // Body.DYNAMIC, Body.SLEEPING, Shape.types.SPHERE

class CannonHaptics extends SpaceHaptics {
    #world; #before; #behind = () => this.after();

    constructor(physvib, world, options) {
        const isMoving = body => body.type === dynamic && body.mass > 0;
        super(physvib, {
            isSoft: false, bodyOf: thing => (thing?.shapes && thing.world !== undefined ? thing : thing?.body?.shapes ? thing.body : undefined), isThere: body => body.world === world,
            massesOf: body => (isMoving(body) ? { massKg: body.mass, inertia: 0, gravityScale: 1 } : { massKg: 0, inertia: 0, gravityScale: 1 }),
            bodies: () => world.bodies, gravity: () => world.gravity, advance: seconds => world.step(seconds),
            look: body => ({ isSensor: !body.collisionResponse || body.isTrigger, isAsleep: body.sleepState === asleep, filters: [{ category: body.collisionFilterGroup, mask: body.collisionFilterMask, group: 0 }] }),
            read(body, to) {
                const { elements: m } = body.invInertiaWorld;
                to.at = body.position;
                to.v = body.velocity;
                to.turns = body.angularVelocity;
                to.inverse = [m[0], m[4], m[8], m[1], m[2], m[5]];
                to.isRound = body.shapes.length === 1 && body.shapes[0].type === ball;
                to.isAsleep = body.sleepState === asleep;
            },
            contacts(tell, placeOf) { // which are told from where bodies were
                for (const { enabled, bi, bj, ri, rj, ni, restitution } of world.contacts) {
                    if (!enabled || bi.isTrigger || bj.isTrigger) continue;
                    const at = plus(placeOf(bi), ri);
                    tell(bi, bj, at, ni, dot(plus(plus(placeOf(bj), rj), at, -1), ni), restitution);
                }
            },
        }, options);
        this.#world = world;
        this.#before = { update: () => this.before(world.dt) };
        world.subsystems.push(this.#before);
        world.addEventListener('postStep', this.#behind);
    }
    detach() {
        const { subsystems } = this.#world, at = subsystems.indexOf(this.#before);
        if (at >= 0) subsystems.splice(at, 1);
        this.#world.removeEventListener('postStep', this.#behind);
    }
}

/** `world`: cannon-es' World; its own step() or fixedStep() goes on. */
export function attach(physvib, world, options = {}) {
    expectEngine(world?.bodies && world.subsystems && world.contacts, "cannon-es' world", world);
    return new CannonHaptics(physvib, world, options);
}
