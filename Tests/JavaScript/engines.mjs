// SPDX-License-Identifier: MIT
// The worlds of worlds.mjs in each engine, through its attachment. `falls`: half a (sub)step's gravity at first, so that semi-implicit falls end on the parabola.
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { load } from './installed.mjs';

const field = { fieldWidth: 10, fieldHeight: 10, fieldX: -5, fieldY: -1 };
const areaOf = body => (body.radius ? Math.PI * body.radius ** 2 : 4 * body.halfWidth * body.halfHeight);
const dropOf = (world, hz, parts) => (world.falls ? world.gravity / 2 / hz / parts : 0);

const matter = async (folder, ...rest) => matterOf((await load(folder, 'matter-js')).default, folder, ...rest);

/** Phaser's own, which needs a page: its parts by themselves. */
async function phaser(folder, ...rest) {
    const inside = createRequire(join(resolve(folder), 'index.js')), part = name => inside(join(resolve(folder), 'node_modules/phaser/src/physics/matter-js/lib', name));
    return matterOf({ Engine: part('core/Engine.js'), Bodies: part('factory/Bodies.js'), Body: part('body/Body.js'), Composite: part('body/Composite.js') }, folder, ...rest);
}

async function matterOf(Matter, folder, physvib, world, hz, { inertiaOf }) {
    const { attach } = await load(folder, 'physvib/matter'), px = 1000;
    const engine = Matter.Engine.create({ gravity: { x: 0, y: 1, scale: world.gravity * px / 1e6 } }), bodies = new Map();
    for (const body of world.bodies) {
        const common = { isStatic: body.isStatic ?? false, restitution: world.restitution, friction: world.friction, frictionAir: 0, angle: -(body.angle ?? 0) };
        const made = body.radius ? Matter.Bodies.circle(body.x * px, -body.y * px, body.radius * px, common, 60)
            : Matter.Bodies.rectangle(body.x * px, -body.y * px, 2 * body.halfWidth * px, 2 * body.halfHeight * px, common);
        if (!body.isStatic) {
            Matter.Body.setMass(made, body.massKg);
            Matter.Body.setInertia(made, inertiaOf(body) * px * px);
            made.deltaTime = 1000 / hz;
            Matter.Body.setVelocity(made, { x: (body.vx ?? 0) * px / 60, y: -dropOf(world, hz, 1) * px / 60 });
        }
        Matter.Composite.add(engine.world, made);
        bodies.set(body.id, made);
    }
    const haptics = attach(physvib, engine, { metresPerUnit: 1 / px, fieldWidth: 10, fieldHeight: 10, fieldX: -5, fieldY: 1 });
    return { haptics, bodies, movesFirst: true, destroy: id => Matter.Composite.remove(engine.world, bodies.get(id)), step: seconds => haptics.step(seconds, () => Matter.Engine.update(engine, seconds * 1000)),
        velocity: id => -Matter.Body.getVelocity(bodies.get(id)).y * 60 / px, velocityX: id => Matter.Body.getVelocity(bodies.get(id)).x * 60 / px, angle: id => -bodies.get(id).angle, x: id => bodies.get(id).position.x / px };
}

async function planck(folder, physvib, world, hz) {
    const planckJs = await load(folder, 'planck'), P = planckJs.default ?? planckJs, { attach } = await load(folder, 'physvib/planck'), engine = new P.World({ gravity: { x: 0, y: -world.gravity } }), bodies = new Map();
    for (const body of world.bodies) {
        const made = engine.createBody({ type: body.isStatic ? 'static' : 'dynamic', position: { x: body.x, y: body.y }, angle: body.angle ?? 0 });
        made.createFixture(body.radius ? new P.Circle(body.radius) : new P.Box(body.halfWidth, body.halfHeight), { density: (body.massKg ?? 0) / areaOf(body), restitution: world.restitution, friction: world.friction });
        if (!body.isStatic) made.setLinearVelocity({ x: body.vx ?? 0, y: dropOf(world, hz, 1) });
        bodies.set(body.id, made);
    }
    const haptics = attach(physvib, engine, field);
    return { haptics, bodies, skin: 0.01, tellsImpulses: true, isWhole: true, movesFirst: true, destroy: id => engine.destroyBody(bodies.get(id)), step: seconds => engine.step(seconds),
        velocity: id => bodies.get(id).getLinearVelocity().y, velocityX: id => bodies.get(id).getLinearVelocity().x, angle: id => bodies.get(id).getAngle(), x: id => bodies.get(id).getPosition().x };
}

async function rapier2d(folder, physvib, world, hz) {
    const { default: R } = await load(folder, '@dimforge/rapier2d-compat'), { attach } = await load(folder, 'physvib/rapier2d');
    await R.init();
    const engine = new R.World({ x: 0, y: -world.gravity }), bodies = new Map();
    for (const body of world.bodies) {
        const made = engine.createRigidBody((body.isStatic ? R.RigidBodyDesc.fixed() : R.RigidBodyDesc.dynamic()).setTranslation(body.x, body.y).setRotation(body.angle ?? 0));
        const shape = (body.radius ? R.ColliderDesc.ball(body.radius) : R.ColliderDesc.cuboid(body.halfWidth, body.halfHeight)).setRestitution(world.restitution).setFriction(world.friction);
        if (!body.isStatic) shape.setMass(body.massKg);
        engine.createCollider(shape, made);
        if (!body.isStatic) made.setLinvel({ x: body.vx ?? 0, y: dropOf(world, hz, engine.integrationParameters.numSolverIterations) }, true);
        bodies.set(body.id, made);
    }
    const haptics = attach(physvib, engine, field);
    return { haptics, bodies, tellsImpulses: true, isWhole: true, destroy: id => engine.removeRigidBody(bodies.get(id)), step: seconds => haptics.update(seconds),
        velocity: id => bodies.get(id).linvel().y, velocityX: id => bodies.get(id).linvel().x, angle: id => bodies.get(id).rotation(), x: id => bodies.get(id).translation().x };
}

let b2;
async function box2d3(folder, physvib, world, hz) {
    b2 ??= await (await import(pathToFileURL(join(resolve(folder), 'node_modules/box2d3-wasm/build/dist/es/entry.mjs')))).default();
    const { attach } = await load(folder, 'physvib/box2d3'), settings = b2.b2DefaultWorldDef(), bodies = new Map();
    settings.gravity.Set(0, -world.gravity);
    const engine = b2.b2CreateWorld(settings);
    for (const body of world.bodies) {
        const def = b2.b2DefaultBodyDef(), form = b2.b2DefaultShapeDef();
        def.type = body.isStatic ? b2.b2BodyType.b2_staticBody : b2.b2BodyType.b2_dynamicBody;
        def.position.Set(body.x, body.y);
        def.rotation = b2.b2MakeRot(body.angle ?? 0);
        if (!body.isStatic) def.linearVelocity.Set(body.vx ?? 0, dropOf(world, hz, 4));
        const made = b2.b2CreateBody(engine, def);
        form.density = (body.massKg ?? 0) / areaOf(body);
        form.material.restitution = world.restitution;
        form.material.friction = world.friction;
        if (body.radius) {
            const circle = new b2.b2Circle();
            circle.center.Set(0, 0);
            circle.radius = body.radius;
            b2.b2CreateCircleShape(made, form, circle);
        } else b2.b2CreatePolygonShape(made, form, b2.b2MakeBox(body.halfWidth, body.halfHeight));
        bodies.set(body.id, made);
    }
    const haptics = attach(physvib, engine, { b2, ...field });
    return { haptics, bodies, tellsImpulses: true, isWhole: true, destroy: id => b2.b2DestroyBody(bodies.get(id)), step: seconds => haptics.update(seconds),
        velocity: id => b2.b2Body_GetLinearVelocity(bodies.get(id)).y, velocityX: id => b2.b2Body_GetLinearVelocity(bodies.get(id)).x,
        angle: id => b2.b2Rot_GetAngle(b2.b2Body_GetRotation(bodies.get(id))), x: id => b2.b2Body_GetPosition(bodies.get(id)).x };
}

export const engines = { matter, phaser, planck, rapier2d, box2d3 };
