// SPDX-License-Identifier: MIT
// Worlds in each engine, through its attachment. `falls`, of a world or a body: half a (sub)step's gravity at first, so that
// semi-implicit falls end on the parabola. A world's `oneWay` is the number of a platform that lets through what rises.
import { createRequire } from 'node:module';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { load } from './installed.mjs';

export const fieldCorner = { x: -5, y: -1 };
const field = { fieldWidth: 10, fieldHeight: 10, fieldX: fieldCorner.x, fieldY: fieldCorner.y };
const areaOf = body => (body.radius ? Math.PI * body.radius ** 2 : 4 * body.halfWidth * body.halfHeight);
const inertiaOf = ({ massKg, radius, halfWidth, halfHeight }) =>
    (radius ? massKg * radius ** 2 / 2 : massKg * (4 * halfWidth ** 2 + 4 * halfHeight ** 2) / 12);
const startOf = (body, world, hz, parts) =>
    ({ x: body.vx ?? 0, y: (body.vy ?? 0) + (body.falls ?? world.falls ? world.gravity / 2 / hz / parts : 0) });
const at = (x, y) => ({ x, y });
const everything = 0xffff, platformBit = 2;

/** Points of a floor without seams, from right to left, `more` beyond its ends. */
function tilePoints({ left, right, count }, more, y = 0) {
    const points = [];
    for (let i = count + more; i >= -more; --i) points.push(at(left + (right - left) * i / count, y));
    return points;
}

/** `engine` with what the platform lets through told by letPass(id, isThrough) before each step. */
function withPlatform(world, engine) {
    const platform = world.bodies.find(body => body.id === world.oneWay);
    if (platform === undefined) return engine;
    const top = platform.y + platform.halfHeight, moving = world.bodies.filter(body => !body.isStatic);
    const step = seconds => {
        for (const { id } of moving) {
            const { y, vy } = engine.motion(id);
            engine.letPass(id, vy > 0.01 || y < top);
        }
        engine.step(seconds);
    };
    return { ...engine, step };
}

const matter = async (folder, ...rest) => matterOf((await load(folder, 'matter-js')).default, folder, ...rest);

/** Phaser's own, which needs a page: its parts by themselves. */
async function phaser(folder, ...rest) {
    const inside = createRequire(join(resolve(folder), 'index.js'));
    const part = name => inside(join(resolve(folder), 'node_modules/phaser/src/physics/matter-js/lib', name));
    const names = { Engine: 'core/Engine', Bodies: 'factory/Bodies', Body: 'body/Body', Composite: 'body/Composite',
        Constraint: 'constraint/Constraint' };
    return matterOf(Object.fromEntries(Object.entries(names).map(([name, path]) => [name, part(`${path}.js`)])), folder, ...rest);
}

async function matterOf(Matter, folder, physvib, world, hz) {
    const { attach } = await load(folder, 'physvib/matter'), px = 1000, perSecond = px / 60, bodies = new Map();
    const engine = Matter.Engine.create({ gravity: { x: 0, y: 1, scale: world.gravity * px / 1e6 } });
    const add = (id, made) => {
        Matter.Composite.add(engine.world, made);
        bodies.set(id, made);
        return made;
    };
    const boxAt = (x, y, width, height, values) => Matter.Bodies.rectangle(x * px, -y * px, width * px, height * px, values);
    const joined = new Set((world.pins ?? []).filter(pin => pin.b !== null).flatMap(({ a, b }) => [a, b]));
    for (const body of world.bodies) {
        const values = { isStatic: body.isStatic ?? false, restitution: world.restitution, friction: world.friction,
            frictionAir: 0, angle: -(body.angle ?? 0) };
        const made = add(body.id, body.radius
            ? Matter.Bodies.circle(body.x * px, -body.y * px, body.radius * px, values, 60)
            : boxAt(body.x, body.y, 2 * body.halfWidth, 2 * body.halfHeight, values));
        if (joined.has(body.id)) made.collisionFilter.group = -1; // Matter knows no joint whose bodies pass each other
        if (body.id === world.oneWay) made.collisionFilter.category = platformBit;
        if (body.isStatic) continue;
        const { x, y } = startOf(body, world, hz, 1);
        Matter.Body.setMass(made, body.massKg);
        Matter.Body.setInertia(made, inertiaOf(body) * px * px);
        made.deltaTime = 1000 / hz;
        Matter.Body.setVelocity(made, at(x * perSecond, -y * perSecond));
        Matter.Body.setAngularVelocity(made, -(body.spin ?? 0) / 60);
    }
    if (world.tiles) { // it has no chains, so they have seams
        const { left, right, count } = world.tiles, wide = (right - left) / count, values = { isStatic: true, friction: world.friction };
        for (let i = 0; i < count; ++i) add(world.tiles.id, boxAt(left + (i + 0.5) * wide, -0.5, wide, 1, values));
    }
    for (const { a, b, x, y } of world.pins ?? []) {
        const from = id => at(x * px - bodies.get(id).position.x, -y * px - bodies.get(id).position.y), point = at(x * px, -y * px);
        // To the world by a rod from the centre, as its own cradle does: it cannot hold a lever.
        const way = b === null ? { pointB: point, length: Math.hypot(from(a).x, from(a).y) }
            : { pointA: from(a), bodyB: bodies.get(b), pointB: from(b), length: 0 };
        Matter.Composite.add(engine.world, Matter.Constraint.create({ bodyA: bodies.get(a), ...way, stiffness: 1 }));
    }
    const haptics = attach(physvib, engine, { metresPerUnit: 1 / px, ...field, fieldY: -fieldCorner.y });
    return withPlatform(world, { haptics, bodies, movesFirst: true,
        destroy: id => Matter.Composite.remove(engine.world, bodies.get(id)),
        step: seconds => haptics.step(seconds, () => Matter.Engine.update(engine, seconds * 1000)),
        letPass: (id, isThrough) => { bodies.get(id).collisionFilter.mask = isThrough ? ~platformBit : -1; },
        motion(id) {
            const { position: { x, y }, angle } = bodies.get(id), v = Matter.Body.getVelocity(bodies.get(id));
            const spin = -Matter.Body.getAngularVelocity(bodies.get(id)) * 60;
            return { x: x / px, y: -y / px, vx: v.x / perSecond, vy: -v.y / perSecond, angle: -angle, spin };
        } });
}

async function planck(folder, physvib, world, hz) {
    const planckJs = await load(folder, 'planck'), P = planckJs.default ?? planckJs, { attach } = await load(folder, 'physvib/planck');
    const engine = new P.World({ gravity: at(0, -world.gravity) }), bodies = new Map(), through = new Set();
    const skin = 0.01; // of polygons: with it they are as large as told
    const surface = { restitution: world.restitution, friction: world.friction };
    for (const body of world.bodies) {
        const size = body.radius ? body : { halfWidth: body.halfWidth - skin, halfHeight: body.halfHeight - skin };
        const made = engine.createBody({ type: body.isStatic ? 'static' : 'dynamic', position: at(body.x, body.y), angle: body.angle ?? 0 });
        made.createFixture(body.radius ? new P.Circle(body.radius) : new P.Box(size.halfWidth, size.halfHeight),
            { density: (body.massKg ?? 0) / areaOf(size), ...surface });
        if (!body.isStatic) {
            made.setLinearVelocity(startOf(body, world, hz, 1));
            made.setAngularVelocity(body.spin ?? 0);
        }
        bodies.set(body.id, made);
    }
    const ground = engine.createBody();
    if (world.tiles) {
        const points = tilePoints(world.tiles, 0, -skin), chain = new P.Chain(points, false);
        chain.setPrevVertex(at(points[0].x + 1, -skin));
        chain.setNextVertex(at(points.at(-1).x - 1, -skin));
        ground.createFixture(chain, surface);
        bodies.set(world.tiles.id, ground);
    }
    for (const { a, b, x, y } of world.pins ?? [])
        engine.createJoint(new P.RevoluteJoint({}, bodies.get(a), b === null ? ground : bodies.get(b), at(x, y)));
    engine.on('pre-solve', contact => {
        const both = [contact.getFixtureA(), contact.getFixtureB()].map(fixture => fixture.getBody());
        if (both.includes(bodies.get(world.oneWay)) && both.some(body => through.has(body))) contact.setEnabled(false);
    });
    const haptics = attach(physvib, engine, field);
    return withPlatform(world, { haptics, bodies, tellsImpulses: true, isWhole: true, movesFirst: true,
        destroy: id => engine.destroyBody(bodies.get(id)), step: seconds => engine.step(seconds, 30), // as box2d.cpp
        letPass: (id, isThrough) => (isThrough ? through.add(bodies.get(id)) : through.delete(bodies.get(id))),
        motion(id) {
            const body = bodies.get(id), { x, y } = body.getWorldCenter(), { x: vx, y: vy } = body.getLinearVelocity();
            return { x, y, vx, vy, angle: body.getAngle(), spin: body.getAngularVelocity() };
        } });
}

async function rapier2d(folder, physvib, world, hz) {
    const { default: R } = await load(folder, '@dimforge/rapier2d-compat'), { attach } = await load(folder, 'physvib/rapier2d');
    await R.init();
    const engine = new R.World(at(0, -world.gravity)), bodies = new Map(), colliders = new Map();
    const covered = shape => shape.setRestitution(world.restitution).setFriction(world.friction);
    for (const body of world.bodies) {
        const kind = body.isStatic ? R.RigidBodyDesc.fixed() : R.RigidBodyDesc.dynamic();
        const made = engine.createRigidBody(kind.setTranslation(body.x, body.y).setRotation(body.angle ?? 0));
        const shape = covered(body.radius ? R.ColliderDesc.ball(body.radius) : R.ColliderDesc.cuboid(body.halfWidth, body.halfHeight));
        if (!body.isStatic) shape.setMass(body.massKg);
        if (body.id === world.oneWay) shape.setCollisionGroups(platformBit << 16 | everything);
        colliders.set(body.id, engine.createCollider(shape, made));
        if (!body.isStatic) {
            made.setLinvel(startOf(body, world, hz, engine.integrationParameters.numSolverIterations), true);
            made.setAngvel(body.spin ?? 0, true);
        }
        bodies.set(body.id, made);
    }
    const ground = engine.createRigidBody(R.RigidBodyDesc.fixed());
    if (world.tiles) {
        const points = new Float32Array(tilePoints(world.tiles, 0).flatMap(({ x, y }) => [x, y]));
        engine.createCollider(covered(R.ColliderDesc.polyline(points, null, R.PolylineFlags?.ORIENTED)), ground);
        bodies.set(world.tiles.id, ground);
    }
    for (const { a, b, x, y } of world.pins ?? []) {
        const both = [a, b].map(id => (id === null ? ground : bodies.get(id)));
        const [one, other] = both.map(body => {
            const from = body.translation(), angle = body.rotation(), [dx, dy] = [x - from.x, y - from.y];
            return at(Math.cos(angle) * dx + Math.sin(angle) * dy, Math.cos(angle) * dy - Math.sin(angle) * dx);
        });
        engine.createImpulseJoint(R.JointData.revolute(one, other), ...both, true).setContactsEnabled(false);
    }
    const haptics = attach(physvib, engine, field);
    return withPlatform(world, { haptics, bodies, tellsImpulses: true, isWhole: true,
        destroy: id => engine.removeRigidBody(bodies.get(id)), step: seconds => haptics.update(seconds),
        letPass: (id, isThrough) => colliders.get(id).setCollisionGroups(1 << 16 | (isThrough ? 1 : everything)),
        motion(id) {
            const body = bodies.get(id), { x, y } = body.worldCom(), { x: vx, y: vy } = body.linvel();
            return { x, y, vx, vy, angle: body.rotation(), spin: body.angvel() };
        } });
}

let b2;
async function box2d3(folder, physvib, world, hz) {
    const path = join(resolve(folder), 'node_modules/box2d3-wasm/build/dist/es/entry.mjs');
    b2 ??= await (await import(pathToFileURL(path))).default();
    const { attach } = await load(folder, 'physvib/box2d3'), settings = b2.b2DefaultWorldDef(), bodies = new Map(), shapes = new Map();
    settings.gravity.Set(0, -world.gravity);
    const engine = b2.b2CreateWorld(settings), { filter } = b2.b2DefaultShapeDef();
    for (const body of world.bodies) {
        const def = b2.b2DefaultBodyDef(), form = b2.b2DefaultShapeDef();
        def.type = body.isStatic ? b2.b2BodyType.b2_staticBody : b2.b2BodyType.b2_dynamicBody;
        def.position.Set(body.x, body.y);
        def.rotation = b2.b2MakeRot(body.angle ?? 0);
        const { x, y } = startOf(body, world, hz, 4);
        if (!body.isStatic) def.linearVelocity.Set(x, y);
        if (!body.isStatic) def.angularVelocity = body.spin ?? 0;
        const made = b2.b2CreateBody(engine, def);
        form.density = (body.massKg ?? 0) / areaOf(body);
        form.material.restitution = world.restitution;
        form.material.friction = world.friction;
        if (body.id === world.oneWay) form.filter.categoryBits = platformBit;
        if (body.radius) {
            const circle = new b2.b2Circle();
            circle.center.Set(0, 0);
            circle.radius = body.radius;
            shapes.set(body.id, b2.b2CreateCircleShape(made, form, circle));
        } else shapes.set(body.id, b2.b2CreatePolygonShape(made, form, b2.b2MakeBox(body.halfWidth, body.halfHeight)));
        bodies.set(body.id, made);
    }
    const ground = b2.b2CreateBody(engine, b2.b2DefaultBodyDef());
    if (world.tiles) {
        const chain = b2.b2DefaultChainDef(), material = b2.b2DefaultSurfaceMaterial();
        material.friction = world.friction;
        chain.SetPoints(tilePoints(world.tiles, 1).map(({ x, y }) => new b2.b2Vec2(x, y))); // with two ghosts
        chain.SetMaterials([material]);
        chain.materialCount = 1;
        b2.b2CreateChain(ground, chain);
        bodies.set(world.tiles.id, ground);
    }
    for (const { a, b, x, y } of world.pins ?? []) {
        const def = b2.b2DefaultRevoluteJointDef(), [one, other] = [a, b].map(id => (id === null ? ground : bodies.get(id)));
        [def.base.bodyIdA, def.base.bodyIdB] = [one, other];
        for (const [frame, body] of [[def.base.localFrameA, one], [def.base.localFrameB, other]]) {
            const local = b2.b2Body_GetLocalPoint(body, new b2.b2Vec2(x, y));
            frame.p.Set(local.x, local.y);
        }
        b2.b2CreateRevoluteJoint(engine, def);
    }
    const haptics = attach(physvib, engine, { b2, ...field });
    return withPlatform(world, { haptics, bodies, tellsImpulses: true, isWhole: true,
        destroy: id => b2.b2DestroyBody(bodies.get(id)), step: seconds => haptics.update(seconds),
        letPass(id, isThrough) {
            filter.maskBits = isThrough ? 1 : everything;
            b2.b2Shape_SetFilter(shapes.get(id), filter);
        },
        motion(id) {
            const body = bodies.get(id), { x, y } = b2.b2Body_GetWorldCenterOfMass(body), v = b2.b2Body_GetLinearVelocity(body);
            const angle = b2.b2Rot_GetAngle(b2.b2Body_GetRotation(body));
            return { x, y, vx: v.x, vy: v.y, angle, spin: b2.b2Body_GetAngularVelocity(body) };
        } });
}

export const engines = { matter, phaser, planck, rapier2d, box2d3 };
