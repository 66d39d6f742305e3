// SPDX-License-Identifier: MIT
// What the kit does in each engine: a few verbs. Lengths are metres, y points up; `halfStep` is the share of a step's gravity that a fall from rest begins with, so that
// the engine's own way of integrating ends on the parabola. An engine without a verb leaves it out: what needs it is not supported there.
import { readFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { pathToFileURL } from 'node:url';
import { load } from '../installed.mjs';

const field = { fieldWidth: 40, fieldHeight: 40, fieldX: -20, fieldY: -20, fullScaleImpulse: 1 };
const areaOf = ({ radius, half }) => (radius ? Math.PI * radius ** 2 : 4 * half[0] * half[1]);
const isDynamic = ({ type = 'dynamic' }) => type === 'dynamic';

async function matter(folder, physvib, { gravity }) {
    const { default: Matter } = await load(folder, 'matter-js'), { attach } = await load(folder, 'physvib/matter'), { Body, Bodies, Composite, Constraint } = Matter, px = 400; // a circle of 0.1 m has 40 sides then, of 100 px/m 10
    const engine = Matter.Engine.create({ gravity: { x: 0, y: 1, scale: gravity * px / 1e6 } }), perSecond = px / 60;
    const add = made => { Composite.add(engine.world, made); return made; };
    const driver = {
        attach: () => attach(physvib, engine, { metresPerUnit: 1 / px, ...field, fieldY: 20 }), halfStep: 1, count: () => Composite.allBodies(engine.world).length,
        create(of) {
            const values = { isStatic: !isDynamic(of), restitution: of.restitution ?? 0, friction: of.friction ?? 0.3, frictionAir: 0, angle: -(of.angle ?? 0), isSensor: of.sensor ?? false, slop: 0.01 };
            const body = add(of.radius ? Bodies.circle(of.x * px, -of.y * px, of.radius * px, values, 60) : Bodies.rectangle(of.x * px, -of.y * px, 2 * of.half[0] * px, 2 * of.half[1] * px, values));
            body.ownKg = of.massKg;
            if (!isDynamic(of)) return body;
            Body.setMass(body, of.massKg);
            if (of.lockTurn) Body.setInertia(body, Infinity);
            driver.fling(body, of.vx ?? 0, of.vy ?? 0, of.spin ?? 0);
            return body;
        },
        get: body => { const v = Body.getVelocity(body); return { x: body.position.x / px, y: -body.position.y / px, vx: v.x / perSecond, vy: -v.y / perSecond, angle: -body.angle, spin: -60 * Body.getAngularVelocity(body), massKg: body.isStatic ? 0 : body.mass }; },
        put: (body, x, y) => Body.setPosition(body, { x: x * px, y: -y * px }),
        fling(body, vx, vy, spin = 0) { Body.setVelocity(body, { x: vx * perSecond, y: -vy * perSecond }); Body.setAngularVelocity(body, -spin / 60); },
        type(body, type) { Body.setStatic(body, type !== 'dynamic'); if (type === 'dynamic' && body.mass === Infinity) { Body.setMass(body, body.ownKg); Body.setInertia(body, body.ownKg * (body.circleRadius || 20) ** 2 / 2); } }, mass: (body, kg) => Body.setMass(body, kg), lockTurn: body => Body.setInertia(body, Infinity),
        gravity: y => { engine.gravity.scale = y * px / 1e6; },
        remove: body => Composite.remove(engine.world, body), sensor: (body, is) => { body.isSensor = is; }, passes: (body, is) => { body.collisionFilter.mask = is ? 0 : 0xffffffff; },
        sleep(body) { engine.enableSleeping = true; Matter.Sleeping.set(body, true); },
        pin: (a, b, x, y) => add(Constraint.create({ bodyA: a, bodyB: b, pointA: { x: x * px - a.position.x, y: -y * px - a.position.y }, pointB: { x: x * px - b.position.x, y: -y * px - b.position.y }, length: 0, stiffness: 1 })),
        step: (seconds, haptics) => haptics.step(seconds, () => Matter.Engine.update(engine, seconds * 1000)),
    };
    return driver;
}

async function planck(folder, physvib, { gravity }) {
    const P = await load(folder, 'planck').then(module => module.default ?? module), { attach } = await load(folder, 'physvib/planck'), world = new P.World({ gravity: { x: 0, y: -gravity } }), skin = 0.01; // of polygons
    const named = type => ({ fixed: 'static' })[type] ?? type;
    const driver = {
        attach: () => attach(physvib, world, field), halfStep: 1, count: () => world.getBodyCount(),
        create(of) {
            const body = world.createBody({ type: named(of.type ?? 'dynamic'), position: { x: of.x, y: of.y }, angle: of.angle ?? 0, linearVelocity: { x: of.vx ?? 0, y: of.vy ?? 0 }, angularVelocity: of.spin ?? 0, bullet: of.bullet ?? false, fixedRotation: of.lockTurn ?? false });
            const half = of.half?.map(length => length - skin);
            body.createFixture(of.radius ? new P.Circle(of.radius) : new P.Box(...half), { density: (of.massKg ?? 0) / areaOf({ radius: of.radius, half }), restitution: of.restitution ?? 0, friction: of.friction ?? 0.3, isSensor: of.sensor ?? false });
            return body;
        },
        get: body => { const { x, y } = body.getWorldCenter(), v = body.getLinearVelocity(); return { x, y, vx: v.x, vy: v.y, angle: body.getAngle(), spin: body.getAngularVelocity(), massKg: body.isDynamic() ? body.getMass() : 0 }; },
        put(body, x, y) { body.setTransform({ x, y }, body.getAngle()); body.setAwake(true); }, fling(body, x, y, spin = 0) { body.setLinearVelocity({ x, y }); body.setAngularVelocity(spin); body.setAwake(true); },
        type: (body, type) => body.setType(named(type)), mass: (body, mass) => body.setMassData({ mass, center: { x: 0, y: 0 }, I: body.getInertia() * mass / body.getMass() }), lockTurn: body => body.setFixedRotation(true),
        gravityScale: (body, scale) => body.setGravityScale(scale), gravity: y => world.setGravity({ x: 0, y: -y }), remove: body => world.destroyBody(body),
        sensor: (body, is) => body.getFixtureList().setSensor(is), passes: (body, is) => body.getFixtureList().setFilterData({ groupIndex: 0, categoryBits: 1, maskBits: is ? 0 : 0xffff }),
        sleep: body => body.setAwake(false), enable: (body, is) => body.setActive(is), moves: (body, vx, vy) => body.setLinearVelocity({ x: vx, y: vy }), shift: (x, y) => world.shiftOrigin({ x, y }),
        pin: (a, b, x, y) => world.createJoint(new P.RevoluteJoint({}, a, b, { x, y })), step: seconds => world.step(seconds, 30, 10),
    };
    return driver;
}

async function rapier(kind, folder, physvib, { gravity }) {
    const { default: R } = await load(folder, `@dimforge/rapier${kind}-compat`), { attach } = await load(folder, `physvib/rapier${kind}`), is3d = kind === '3d';
    await R.init();
    const at = (x, y) => (is3d ? { x, y, z: 0 } : { x, y }), list = (x, y) => (is3d ? [x, y, 0] : [x, y]), world = new R.World(at(0, -gravity));
    const types = { dynamic: R.RigidBodyType.Dynamic, fixed: R.RigidBodyType.Fixed, kinematic: R.RigidBodyType.KinematicVelocityBased }, turned = angle => (is3d ? { x: 0, y: 0, z: Math.sin(angle / 2), w: Math.cos(angle / 2) } : angle);
    const driver = {
        attach: () => attach(physvib, world, field), halfStep: 1 / world.integrationParameters.numSolverIterations, count: () => world.bodies.len(),
        create(of) {
            const desc = new R.RigidBodyDesc(types[of.type ?? 'dynamic']).setTranslation(...list(of.x, of.y)).setLinvel(...list(of.vx ?? 0, of.vy ?? 0)).setCcdEnabled(of.bullet ?? false).setCanSleep(of.sleeps ?? false);
            desc.setRotation(turned(of.angle ?? 0));
            desc.setAngvel(is3d ? { x: 0, y: 0, z: of.spin ?? 0 } : of.spin ?? 0);
            if (is3d) desc.restrictRotations?.(false, false, !of.lockTurn);
            if (is3d) desc.enabledRotations?.(false, false, !of.lockTurn);
            if (!is3d && of.lockTurn) desc.lockRotations();
            const body = world.createRigidBody(desc), form = of.radius ? R.ColliderDesc.ball(of.radius) : R.ColliderDesc.cuboid(...of.half, ...(is3d ? [of.type === 'fixed' ? 5 : of.half[0]] : []));
            if (isDynamic(of)) form.setMass(of.massKg);
            form.setRestitutionCombineRule(R.CoefficientCombineRule.Max).setSensor(of.sensor ?? false);
            world.createCollider(form.setRestitution(of.restitution ?? 0).setFriction(of.friction ?? 0.3), body);
            return body;
        },
        get(body) { if (world.bodies.get(body.handle) !== body) throw new Error('gone'); const { x, y } = body.worldCom(), v = body.linvel(), spin = body.angvel(), turn = body.rotation(); return { x, y, vx: v.x, vy: v.y, angle: is3d ? 2 * Math.atan2(turn.z, turn.w) : turn, spin: is3d ? spin.z : spin, massKg: body.isDynamic() ? body.mass() : 0 }; },
        put: (body, x, y) => body.setTranslation(at(x, y), true), fling(body, vx, vy, spin = 0) { body.setLinvel(at(vx, vy), true); body.setAngvel(is3d ? { x: 0, y: 0, z: spin } : spin, true); },
        type: (body, type) => body.setBodyType(types[type], true), mass: (body, kg) => body.collider(0).setMass(kg), lockTurn: body => body.lockRotations(true, true), lockX: body => body.setEnabledTranslations(...(is3d ? [false, true, true] : [false, true]), true),
        gravityScale: (body, scale) => body.setGravityScale(scale, true), gravity: y => { world.gravity = at(0, -y); }, remove: body => world.removeRigidBody(body), sensor: (body, is) => body.collider(0).setSensor(is),
        passes: (body, is) => body.collider(0).setCollisionGroups(is ? 0x00010000 : 0xffffffff), sleep: body => body.sleep(), enable: (body, is) => body.setEnabled(is), moves: (body, vx, vy) => body.setLinvel(at(vx, vy), true),
        moveTo(body, x, y) { if (!body.isKinematic() || body.bodyType() !== R.RigidBodyType.KinematicPositionBased) body.setBodyType(R.RigidBodyType.KinematicPositionBased, true); body.setNextKinematicTranslation(at(x, y)); },
        dominates: (body, group) => body.setDominanceGroup(group), touchesAll: body => body.collider(0).setActiveCollisionTypes(R.ActiveCollisionTypes.ALL), bounces: (body, restitution) => body.collider(0).setRestitution(restitution), grow: (body, radius) => body.collider(0).setRadius(radius),
        pin(a, b, x, y) { const from = ({ x: bx, y: by }) => at(x - bx, y - by); world.createImpulseJoint(R.JointData[is3d ? 'spherical' : 'revolute'](from(a.translation()), from(b.translation())), a, b, true).setContactsEnabled(false); },
        step: (seconds, haptics) => haptics.update(seconds),
    };
    return driver;
}

let b2;
async function box2d3(folder, physvib, { gravity }) {
    b2 ??= await (await import(pathToFileURL(join(resolve(folder), 'node_modules/box2d3-wasm/build/dist/es/entry.mjs')))).default();
    const { attach } = await load(folder, 'physvib/box2d3'), settings = b2.b2DefaultWorldDef(), types = { dynamic: b2.b2BodyType.b2_dynamicBody, fixed: b2.b2BodyType.b2_staticBody, kinematic: b2.b2BodyType.b2_kinematicBody };
    settings.gravity.Set(0, -gravity);
    const world = b2.b2CreateWorld(settings), shapes = new Map(), keyOf = body => `${body.index1},${body.generation}`, at = (x, y) => new b2.b2Vec2(x, y);
    let count = 0;
    const driver = {
        attach: () => attach(physvib, world, { b2, ...field }), isSteppedByOne: true, halfStep: 1 / 4, count: () => count,
        create(of) {
            const def = b2.b2DefaultBodyDef(), form = b2.b2DefaultShapeDef();
            def.type = types[of.type ?? 'dynamic'];
            def.position.Set(of.x, of.y);
            def.rotation = b2.b2MakeRot(of.angle ?? 0);
            def.linearVelocity.Set(of.vx ?? 0, of.vy ?? 0);
            def.angularVelocity = of.spin ?? 0;
            def.isBullet = of.bullet ?? false;
            if (of.lockTurn) def.motionLocks.angularZ = true;
            const body = b2.b2CreateBody(world, def);
            form.density = (of.massKg ?? 0) / areaOf(of);
            form.material.restitution = of.restitution ?? 0;
            form.material.friction = of.friction ?? 0.3;
            form.isSensor = of.sensor ?? false;
            const circle = new b2.b2Circle();
            circle.center.Set(0, 0);
            circle.radius = of.radius ?? 0;
            shapes.set(keyOf(body), of.radius ? b2.b2CreateCircleShape(body, form, circle) : b2.b2CreatePolygonShape(body, form, b2.b2MakeBox(...of.half)));
            ++count;
            return body;
        },
        get: body => { const { x, y } = b2.b2Body_GetWorldCenterOfMass(body), v = b2.b2Body_GetLinearVelocity(body); return { x, y, vx: v.x, vy: v.y, angle: b2.b2Rot_GetAngle(b2.b2Body_GetRotation(body)), spin: b2.b2Body_GetAngularVelocity(body), massKg: b2.b2Body_GetType(body).value === types.dynamic.value ? b2.b2Body_GetMass(body) : 0 }; },
        put: (body, x, y) => b2.b2Body_SetTransform(body, at(x, y), b2.b2Body_GetRotation(body)), fling(body, x, y, spin = 0) { b2.b2Body_SetAwake(body, true); b2.b2Body_SetLinearVelocity(body, at(x, y)); b2.b2Body_SetAngularVelocity(body, spin); },
        type: (body, type) => b2.b2Body_SetType(body, types[type]), mass(body, kg) { const data = b2.b2Body_GetMassData(body); data.rotationalInertia *= kg / data.mass; data.mass = kg; b2.b2Body_SetMassData(body, data); },
        gravityScale: (body, scale) => b2.b2Body_SetGravityScale(body, scale), gravity: y => b2.b2World_SetGravity(world, at(0, -y)), remove(body) { b2.b2DestroyBody(body); --count; },
        passes(body, is) { const { filter } = b2.b2DefaultShapeDef(); if (is) filter.maskBits = 0; b2.b2Shape_SetFilter(shapes.get(keyOf(body)), filter); }, sleep: body => b2.b2Body_SetAwake(body, false), enable: (body, is) => b2[is ? 'b2Body_Enable' : 'b2Body_Disable'](body),
        moves: (body, vx, vy) => b2.b2Body_SetLinearVelocity(body, at(vx, vy)), moveTo(body, x, y, seconds) { const transform = b2.b2Body_GetTransform(body); transform.p.Set(x, y); b2.b2Body_SetTargetTransform(body, transform, seconds); },
        pin(a, b, x, y) {
            const def = b2.b2DefaultRevoluteJointDef();
            [def.base.bodyIdA, def.base.bodyIdB] = [a, b];
            for (const [frame, body] of [[def.base.localFrameA, a], [def.base.localFrameB, b]]) { const local = b2.b2Body_GetLocalPoint(body, at(x, y)); frame.p.Set(local.x, local.y); }
            b2.b2CreateRevoluteJoint(world, def);
        },
        step: (seconds, haptics) => haptics.update(seconds), end: () => b2.b2DestroyWorld(world), // there is room for 128
    };
    return driver;
}

async function cannon(folder, physvib, { gravity }) {
    const C = await load(folder, 'cannon-es'), { attach } = await load(folder, 'physvib/cannon'), world = new C.World({ gravity: new C.Vec3(0, -gravity, 0) });
    Object.assign(world.solver, { iterations: 30, tolerance: 0 });
    Object.assign(world.defaultContactMaterial, { contactEquationRelaxation: 3, contactEquationStiffness: 1e8, friction: 0.3, restitution: 0 });
    const types = { dynamic: C.Body.DYNAMIC, fixed: C.Body.STATIC, kinematic: C.Body.KINEMATIC }, bouncy = new Map();
    const materialOf = (restitution, friction) => { // of a pair, the larger
        const key = `${restitution},${friction}`;
        if (!bouncy.has(key)) {
            const made = Object.assign(new C.Material(), { ownRestitution: restitution, ownFriction: friction });
            for (const other of [made, ...bouncy.values()]) world.addContactMaterial(new C.ContactMaterial(made, other, { ...world.defaultContactMaterial, friction: Math.min(friction, other.ownFriction), restitution: Math.max(restitution, other.ownRestitution) }));
            bouncy.set(key, made);
        }
        return bouncy.get(key);
    };
    const driver = {
        attach: () => attach(physvib, world, field), halfStep: 1, count: () => world.bodies.length, sinks: 0.12, // m: it looks where bodies overlap
        create(of) {
            const body = new C.Body({ type: types[of.type ?? 'dynamic'], mass: isDynamic(of) ? of.massKg : 0, position: new C.Vec3(of.x, of.y, 0), velocity: new C.Vec3(of.vx ?? 0, of.vy ?? 0, 0), linearDamping: 0, angularDamping: 0, material: materialOf(of.restitution ?? 0, of.friction ?? 0.3), isTrigger: of.sensor ?? false,
                shape: of.radius ? new C.Sphere(of.radius) : new C.Box(new C.Vec3(...of.half, isDynamic(of) ? of.half[0] : 5)) });
            body.ownKg = of.massKg;
            body.angularFactor.set(0, 0, 1);
            body.linearFactor.set(1, 1, 0);
            body.quaternion.setFromAxisAngle(new C.Vec3(0, 0, 1), of.angle ?? 0);
            if (of.lockTurn) driver.lockTurn(body);
            world.addBody(body);
            return body;
        },
        get(body) { if (body.world !== world) throw new Error('gone'); const { position: { x, y }, velocity, quaternion: q } = body; return { x, y, vx: velocity.x, vy: velocity.y, angle: 2 * Math.atan2(q.z, q.w), spin: body.angularVelocity.z, massKg: body.type === C.Body.DYNAMIC ? body.mass : 0 }; },
        put(body, x, y) { body.position.set(x, y, 0); body.aabbNeedsUpdate = true; body.wakeUp(); }, fling(body, vx, vy, spin = 0) { body.velocity.set(vx, vy, 0); body.angularVelocity.set(0, 0, spin); body.wakeUp(); },
        type(body, type) { body.type = types[type]; body.mass = type === 'dynamic' ? body.ownKg : 0; body.updateMassProperties(); }, mass(body, kg) { body.mass = body.ownKg = kg; body.updateMassProperties(); },
        lockTurn(body) { body.fixedRotation = true; body.updateMassProperties(); }, gravity: y => world.gravity.set(0, -y, 0), remove: body => world.removeBody(body), sensor: (body, is) => { body.isTrigger = is; },
        passes: (body, is) => { body.collisionFilterMask = is ? 0 : -1; }, sleep(body) { world.allowSleep = true; body.sleep(); }, moves: (body, vx, vy) => body.velocity.set(vx, vy, 0),
        grow(body, radius) { body.shapes[0].radius = radius; body.shapes[0].updateBoundingSphereRadius(); body.updateBoundingRadius(); },
        pin(a, b, x, y) { const from = body => new C.Vec3(x - body.position.x, y - body.position.y, 0); world.addConstraint(new C.PointToPointConstraint(a, from(a), b, from(b))); },
        step: seconds => world.step(seconds),
    };
    return driver;
}

let havokModule;
/** Havok's own package, or through Babylon's layer on an engine that draws nothing. */
async function havok(isBabylon, folder, physvib, { gravity }) {
    havokModule ??= await (await load(folder, '@babylonjs/havok')).default({ wasmBinary: readFileSync(join(resolve(folder), 'node_modules/@babylonjs/havok/lib/esm/HavokPhysics.wasm')) });
    const hk = havokModule, { attach } = await load(folder, 'physvib/havok'), types = { dynamic: hk.MotionType.DYNAMIC, fixed: hk.MotionType.STATIC, kinematic: hk.MotionType.KINEMATIC }, of = (call, ...given) => hk[call](...given)[1], bodies = new Set(), pull = [0, -gravity, 0];
    let world = isBabylon ? null : of('HP_World_Create'), scene;
    if (isBabylon) {
        const B = await load(folder, '@babylonjs/core');
        B.Logger.LogLevels = B.Logger.NoneLogLevel;
        scene = new B.Scene(new B.NullEngine());
        scene.enablePhysics(new B.Vector3(0, -gravity, 0), new B.HavokPlugin(true, hk));
        ({ world } = scene.getPhysicsEngine().getPhysicsPlugin());
        Object.assign(scene, { B });
    } else hk.HP_World_SetGravity(world, pull);
    const idOf = body => body._pluginData?.hpBodyId ?? body, turned = angle => [0, 0, Math.sin(angle / 2), Math.cos(angle / 2)];
    const setMass = (id, kg, isLocked) => { const [centre, , moments, turn] = of('HP_Shape_BuildMassProperties', of('HP_Body_GetShape', id)); hk.HP_Body_SetMassProperties(id, [centre, kg, isLocked ? [0, 0, 0] : moments, turn]); }; // moments are those of 1 kg
    const driver = {
        attach: () => attach(physvib, isBabylon ? scene : { havok: hk, world, bodies: () => bodies, gravity: () => pull }, field), halfStep: 1 / 4, count: () => bodies.size,
        create(of3) {
            let body, id;
            const shape = of3.radius ? of('HP_Shape_CreateSphere', [0, 0, 0], of3.radius) : of('HP_Shape_CreateBox', [0, 0, 0], [0, 0, 0, 1], [2 * of3.half[0], 2 * of3.half[1], isDynamic(of3) ? 2 * of3.half[0] : 10]);
            hk.HP_Shape_SetMaterial(shape, [of3.friction ?? 0.3, of3.friction ?? 0.3, of3.restitution ?? 0, hk.MaterialCombine.MINIMUM, hk.MaterialCombine.MAXIMUM]);
            if (of3.sensor) hk.HP_Shape_SetTrigger(shape, true);
            if (isBabylon) {
                const node = new scene.B.TransformNode('', scene);
                node.position.set(of3.x, of3.y, 0);
                node.rotationQuaternion = new scene.B.Quaternion(...turned(of3.angle ?? 0));
                body = new scene.B.PhysicsBody(node, { fixed: 0, kinematic: 1, dynamic: 2 }[of3.type ?? 'dynamic'], false, scene);
                body.disablePreStep = true;
                id = idOf(body);
            } else {
                body = id = of('HP_Body_Create');
                hk.HP_Body_SetMotionType(id, types[of3.type ?? 'dynamic']);
            }
            hk.HP_Body_SetShape(id, shape);
            setMass(id, of3.massKg || 1, of3.lockTurn);
            hk.HP_Body_SetQTransform(id, [[of3.x, of3.y, 0], turned(of3.angle ?? 0)]);
            hk.HP_Body_SetLinearDamping(id, 0);
            hk.HP_Body_SetAngularDamping(id, 0);
            if (!isBabylon) hk.HP_World_AddBody(world, id, false);
            driver.fling(body, of3.vx ?? 0, of3.vy ?? 0, of3.spin ?? 0);
            bodies.add(body);
            return body;
        },
        get(body) { if (!bodies.has(body)) throw new Error('gone'); const id = idOf(body), [[x, y], [, , s, c]] = of('HP_Body_GetQTransform', id), [vx, vy] = of('HP_Body_GetLinearVelocity', id); return { x, y, vx, vy, angle: 2 * Math.atan2(s, c), spin: of('HP_Body_GetAngularVelocity', id)[2], massKg: of('HP_Body_GetMotionType', id) === types.dynamic ? of('HP_Body_GetMassProperties', id)[1] : 0 }; },
        put: (body, x, y) => hk.HP_Body_SetPosition(idOf(body), [x, y, 0]), fling(body, vx, vy, spin = 0) { hk.HP_Body_SetActivationState(idOf(body), hk.ActivationState.ACTIVE); hk.HP_Body_SetLinearVelocity(idOf(body), [vx, vy, 0]); hk.HP_Body_SetAngularVelocity(idOf(body), [0, 0, spin]); },
        type: (body, type) => hk.HP_Body_SetMotionType(idOf(body), types[type]), mass: (body, kg) => setMass(idOf(body), kg), lockTurn: body => setMass(idOf(body), of('HP_Body_GetMassProperties', idOf(body))[1], true),
        gravityScale: (body, scale) => hk.HP_Body_SetGravityFactor(idOf(body), scale), gravity(y) { if (isBabylon) scene.getPhysicsEngine().setGravity(new scene.B.Vector3(0, -y, 0)); else { pull[1] = -y; hk.HP_World_SetGravity(world, pull); } },
        remove(body) { bodies.delete(body); if (isBabylon) { const { transformNode } = body; body.dispose(); transformNode.dispose(); } else { hk.HP_World_RemoveBody(world, body); hk.HP_Body_Release(body); } },
        sensor: (body, is) => hk.HP_Shape_SetTrigger(of('HP_Body_GetShape', idOf(body)), is), passes: (body, is) => hk.HP_Shape_SetFilterInfo(of('HP_Body_GetShape', idOf(body)), is ? [1, 0] : [0xffffffff, 0xffffffff]),
        sleep: body => hk.HP_Body_SetActivationState(idOf(body), hk.ActivationState.INACTIVE), moves: (body, vx, vy) => hk.HP_Body_SetLinearVelocity(idOf(body), [vx, vy, 0]), moveTo: (body, x, y) => hk.HP_Body_SetTargetQTransform(idOf(body), [[x, y, 0], [0, 0, 0, 1]]),
        step(seconds) { hk.HP_World_SetIdealStepTime(world, seconds || 1 / 60); if (isBabylon) scene.getPhysicsEngine()._step(seconds); else hk.HP_World_Step(world, seconds); },
        end: () => (isBabylon ? scene.dispose() : hk.HP_World_Release(world)),
    };
    return driver;
}

let joltModule;
async function jolt(folder, physvib, { gravity }) {
    const J = joltModule ??= await (await load(folder, 'jolt-physics')).default(), { attach } = await load(folder, 'physvib/jolt'), settings = new J.JoltSettings(), pairs = new J.ObjectLayerPairFilterTable(3), layers = new J.BroadPhaseLayerInterfaceTable(3, 2), [fixed, moving, passing] = [0, 1, 2];
    Object.assign(settings, { mMaxWorkerThreads: 0, mMaxBodies: 1024, mMaxBodyPairs: 1024, mMaxContactConstraints: 1024 });
    pairs.EnableCollision(fixed, moving);
    pairs.EnableCollision(moving, moving);
    for (const [layer, broad] of [[fixed, 0], [moving, 1], [passing, 1]]) layers.MapObjectToBroadPhaseLayer(layer, new J.BroadPhaseLayer(broad));
    Object.assign(settings, { mObjectLayerPairFilter: pairs, mBroadPhaseLayerInterface: layers, mObjectVsBroadPhaseLayerFilter: new J.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 3) });
    const world = new J.JoltInterface(settings), system = world.GetPhysicsSystem(), bodies = system.GetBodyInterface(), vector = new J.Vec3(0, 0, 0), place3 = new J.RVec3(0, 0, 0), v = (x, y, z = 0) => { vector.Set(x, y, z); return vector; }, at = (x, y) => { place3.Set(x, y, 0); return place3; }, on = J.EActivation_Activate, there = new Set();
    const types = { dynamic: J.EMotionType_Dynamic, fixed: J.EMotionType_Static, kinematic: J.EMotionType_Kinematic }, quat = new J.Quat(0, 0, 0, 1), turned = angle => { quat.Set(0, 0, Math.sin(angle / 2), Math.cos(angle / 2)); return quat; };
    system.SetGravity(v(0, -gravity));
    const driver = {
        attach: () => attach(physvib, { Jolt: J, interface: world }, field), halfStep: 1, count: () => there.size,
        create(of) {
            const shape = of.radius ? new J.SphereShape(of.radius) : new J.BoxShape(v(of.half[0], of.half[1], isDynamic(of) ? of.half[0] : 5), 0);
            const made = new J.BodyCreationSettings(shape, at(of.x, of.y), turned(of.angle ?? 0), types[of.type ?? 'dynamic'], of.type === 'fixed' && !of.massKg ? fixed : moving);
            Object.assign(made, { mRestitution: of.restitution ?? 0, mFriction: of.friction ?? 0.3, mLinearDamping: 0, mAngularDamping: 0, mAllowSleeping: false, mIsSensor: of.sensor ?? false, mAllowDynamicOrKinematic: true, mGravityFactor: 1, mMotionQuality: of.bullet ? J.EMotionQuality_LinearCast : J.EMotionQuality_Discrete,
                mAllowedDOFs: J.EAllowedDOFs_TranslationX | J.EAllowedDOFs_TranslationY | (of.lockTurn ? 0 : J.EAllowedDOFs_RotationZ), mOverrideMassProperties: J.EOverrideMassProperties_CalculateInertia });
            made.mMassPropertiesOverride.mMass = of.massKg || 1;
            const body = bodies.CreateBody(made);
            J.destroy(made);
            bodies.AddBody(body.GetID(), on);
            const held = { body, id: new J.BodyID(body.GetID().GetIndexAndSequenceNumber()), GetID: () => held.id };
            there.add(held);
            driver.fling(held, of.vx ?? 0, of.vy ?? 0, of.spin ?? 0);
            return held;
        },
        get(held) { if (!there.has(held)) throw new Error('gone'); const { body } = held, place = body.GetCenterOfMassPosition(), x = place.GetX(), y = place.GetY(), speed = body.GetLinearVelocity(), vx = speed.GetX(), vy = speed.GetY(), turn = body.GetRotation(); return { x, y, vx, vy, angle: 2 * Math.atan2(turn.GetZ(), turn.GetW()), spin: body.GetAngularVelocity().GetZ(), massKg: body.IsDynamic() ? 1 / body.GetMotionProperties().GetInverseMass() : 0 }; },
        put: (held, x, y) => bodies.SetPosition(held.id, at(x, y), on), fling(held, x, y, spin = 0) { if (held.body.IsStatic()) return; bodies.SetLinearVelocity(held.id, v(x, y)); bodies.SetAngularVelocity(held.id, v(0, 0, spin)); bodies.ActivateBody(held.id); },
        type: (held, type) => bodies.SetMotionType(held.id, types[type], on), mass(held, kg) { const motion = held.body.GetMotionProperties(), by = motion.GetInverseMass() * kg, inertia = motion.GetInverseInertiaDiagonal(), [x, y, z] = [inertia.GetX(), inertia.GetY(), inertia.GetZ()]; motion.SetInverseMass(1 / kg); motion.SetInverseInertia(v(x / by, y / by, z / by), new J.Quat(0, 0, 0, 1)); },
        gravityScale: (held, scale) => bodies.SetGravityFactor(held.id, scale), gravity: y => system.SetGravity(v(0, -y)), remove(held) { there.delete(held); bodies.RemoveBody(held.id); bodies.DestroyBody(held.id); J.destroy(held.id); },
        sensor: (held, is) => held.body.SetIsSensor(is), passes: (held, is) => bodies.SetObjectLayer(held.id, is ? passing : moving), sleep: held => bodies.DeactivateBody(held.id),
        moves: (held, x, y) => bodies.SetLinearVelocity(held.id, v(x, y)), moveTo: (held, x, y, seconds) => bodies.MoveKinematic(held.id, at(x, y), turned(0), seconds),
        pin(a, b, x, y) { const joint = new J.PointConstraintSettings(); joint.mPoint1 = joint.mPoint2 = at(x, y); system.AddConstraint(joint.Create(a.body, b.body)); },
        step: seconds => world.Step(seconds, 1), end: () => J.destroy(world),
    };
    return driver;
}

let mujocoModule;
/** Its model is compiled when the first step comes; bodies move in the plane. By steps of 2 ms at most. */
async function mujoco(folder, physvib, { gravity }) {
    const M = mujocoModule ??= await (await load(folder, '@mujoco/mujoco')).default(), { attach } = await load(folder, 'physvib/mujoco'), all = [], waiting = [];
    let model = null, data = null, haptics = null, options = null;
    const solref = e => { const log = Math.log(e || 1e-9), ratio = e > 0 ? -log / Math.hypot(Math.PI, log) : 1; return `0.02 ${ratio}`; }; // the first as it is at first
    const bodyOf = (of, i) => `<body name="b${i}" pos="${of.x} 0 ${of.y}" euler="0 ${-(of.angle ?? 0) * 180 / Math.PI} 0">${isDynamic(of) ? `<joint name="x${i}" type="slide" axis="1 0 0"/><joint name="z${i}" type="slide" axis="0 0 1"/>${of.lockTurn ? '' : `<joint name="w${i}" type="hinge" axis="0 -1 0"/>`}` : ''}
        <geom type="${of.radius ? 'sphere' : 'box'}" size="${of.radius ?? `${of.half[0]} ${isDynamic(of) ? of.half[0] : 5} ${of.half[1]}`}" mass="${of.massKg || 1}" solref="${solref(of.restitution)}" friction="${of.friction ?? 0.3} 0 0" condim="3" solimp="0.99 0.99 0.001"/></body>`;
    function compile() {
        model = M.MjModel.from_xml_string(`<mujoco><option timestep="0.002" gravity="0 0 ${-gravity}" cone="elliptic"/><worldbody>${all.map(bodyOf).join('')}</worldbody></mujoco>`);
        data = new M.MjData(model);
        for (const [i, of] of all.entries()) if (isDynamic(of)) { driver.fling(i, of.vx ?? 0, of.vy ?? 0, of.spin ?? 0); }
        M.mj_forward(model, data);
        if (options) haptics = attach(physvib, { mujoco: M, model, data }, options);
        for (const [body, values] of waiting) haptics.set(`b${body}`, values);
    }
    // Slide, slide, hinge: three numbers of each moving body, in order.
    const placeOf = body => all.slice(0, body).reduce((sum, of) => sum + (isDynamic(of) ? 3 - (of.lockTurn ? 1 : 0) : 0), 0);
    const driver = {
        hasNoKinematic: true, isClosed: true, pushesApart: true, halfStep: 1, halfSeconds: 0.002, count: () => all.length, sinks: 0.12,
        attach() { options = field; return { set(body, values) { waiting.push([body, values]); if (haptics) haptics.set(`b${body}`, values); return body + 1; }, take(atOnce) { const numbers = new Map(all.map((_, i) => [haptics.id(i + 1), i + 1])); return haptics.take(atOnce).map(event => ({ ...event, fixture: numbers.get(event.fixture) })); }, explain: () => haptics?.explain() ?? '', get error() { return haptics?.error ?? null; }, free: () => haptics?.free() }; },
        create(of) { all.push({ ...of }); return all.length - 1; },
        get(body) { const of = all[body], at = placeOf(body), q = data?.qpos, v = data?.qvel, isFree = isDynamic(of) && data; return { x: of.x + (isFree ? q[at] : 0), y: of.y + (isFree ? q[at + 1] : 0), vx: isFree ? v[at] : of.vx ?? 0, vy: isFree ? v[at + 1] : of.vy ?? 0, angle: (of.angle ?? 0) + (isFree && !of.lockTurn ? q[at + 2] : 0), spin: isFree && !of.lockTurn ? v[at + 2] : 0, massKg: isDynamic(of) ? data ? model.body_mass[body + 1] : of.massKg : 0 }; },
        put(body, x, y) { const of = all[body]; if (!data || !isDynamic(of)) { Object.assign(of, { x, y }); if (data) { model.body_pos[3 * body + 3] = x; model.body_pos[3 * body + 5] = y; } return; } const at = placeOf(body); data.qpos[at] = x - of.x; data.qpos[at + 1] = y - of.y; },
        fling(body, vx, vy, spin = 0) { if (!data) { Object.assign(all[body], { vx, vy, spin }); return; } const at = placeOf(body); data.qvel[at] = vx; data.qvel[at + 1] = vy; if (!all[body].lockTurn) data.qvel[at + 2] = spin; },
        mass(body, kg) { if (!data) compile(); const by = kg / model.body_mass[body + 1]; model.body_mass[body + 1] = kg; for (let i = 3; i < 6; ++i) model.body_inertia[3 * body + i] *= by; const at = placeOf(body), q = [...data.qpos], v = [...data.qvel]; M.mj_setConst(model, data); q.forEach((value, i) => { data.qpos[i] = value; }); v.forEach((value, i) => { data.qvel[i] = value; }); },
        gravity(y) { model.opt.gravity[2] = -y; }, passes(body, is) { if (!data) compile(); const geom = model.body_geomadr[body + 1]; model.geom_contype[geom] = model.geom_conaffinity[geom] = is ? 0 : 1; },
        step(seconds) {
            if (!data) compile();
            const count = Math.ceil(seconds / 0.002 - 1e-9);
            if (count > 0) model.opt.timestep = seconds / count;
            for (let i = 0; i < count; ++i) haptics.update();
        },
        end() { data?.delete(); model?.delete(); },
    };
    return driver;
}

/** A game's own: circles, and boxes that do not turn. */
async function velocities(folder, physvib, { gravity }) {
    const { attachVelocities } = await load(folder, 'physvib/velocities'), { apart, stateOf } = await load(folder, 'physvib/velocities').then(() => ({ apart: near, stateOf: null })), bodies = new Set(), pull = { x: 0, y: -gravity };
    function near(a, b) {
        const dx = b.x - a.x, dy = b.y - a.y;
        if (a.radius && b.radius) { const length = Math.hypot(dx, dy) || 1; return { gap: length - a.radius - b.radius, nx: dx / length, ny: dy / length }; }
        const outX = Math.abs(dx) - (a.width + b.width) / 2, outY = Math.abs(dy) - (a.height + b.height) / 2;
        return outX > outY ? { gap: outX, nx: Math.sign(dx) || 1, ny: 0 } : { gap: outY, nx: 0, ny: Math.sign(dy) || 1 };
    }
    function advance(seconds) {
        for (const body of bodies) {
            if (body.massKg > 0 && !body.isAsleep) body.vy += pull.y * body.gravityScale * seconds;
            if (!body.isAsleep) { body.x += body.vx * seconds; body.y += body.vy * seconds; }
        }
        const all = [...bodies];
        for (let i = 0; i < all.length; ++i) for (let j = i + 1; j < all.length; ++j) {
            const [a, b] = [all[i], all[j]], inverse = (a.massKg > 0 ? 1 / a.massKg : 0) + (b.massKg > 0 ? 1 / b.massKg : 0);
            if (inverse === 0 || a.isSensor || b.isSensor || a.isPassed || b.isPassed) continue;
            const { gap, nx, ny } = apart(a, b), closing = (a.vx - b.vx) * nx + (a.vy - b.vy) * ny;
            if (gap >= 0) continue;
            for (const [body, way] of [[a, 1], [b, -1]]) if (body.massKg > 0) { body.x += way * gap * nx / body.massKg / inverse; body.y += way * gap * ny / body.massKg / inverse; body.isAsleep = false; }
            if (closing <= 0) continue;
            const impulse = closing * (1 + (closing > 0.5 ? Math.max(a.restitution, b.restitution) : 0)) / inverse;
            for (const [body, way] of [[a, -1], [b, 1]]) if (body.massKg > 0) { body.vx += way * impulse * nx / body.massKg; body.vy += way * impulse * ny / body.massKg; }
        }
    }
    return {
        attach: () => attachVelocities(physvib, { bodies: () => [...bodies].filter(body => !body.isSensor && !body.isPassed), read: (body, to) => Object.assign(to, { x: body.x, y: body.y, vx: body.vx, vy: body.vy, width: body.width, height: body.height, radius: body.radius, massKg: body.massKg, gravityScale: body.gravityScale }), gravity: () => pull },
            { metresPerUnit: 1, yDown: false, ...field }), isSteppedByOne: true, halfStep: 1, count: () => bodies.size, isUnturned: true,
        create(of) { const body = { x: of.x, y: of.y, vx: of.vx ?? 0, vy: of.vy ?? 0, radius: of.radius ?? 0, width: 2 * (of.radius ?? of.half[0]), height: 2 * (of.radius ?? of.half[1]), massKg: isDynamic(of) ? of.massKg : 0, ownKg: of.massKg, gravityScale: 1, restitution: of.restitution ?? 0, isSensor: of.sensor ?? false }; bodies.add(body); return body; },
        get: ({ x, y, vx, vy, massKg }) => ({ x, y, vx, vy, angle: 0, spin: 0, massKg }), put: (body, x, y) => Object.assign(body, { x, y }), fling: (body, vx, vy) => Object.assign(body, { vx, vy }),
        type: (body, type) => Object.assign(body, { massKg: type === 'dynamic' ? body.ownKg : 0 }), mass: (body, massKg) => Object.assign(body, { massKg }), gravityScale: (body, gravityScale) => Object.assign(body, { gravityScale }), gravity: y => { pull.y = -y; },
        remove: body => bodies.delete(body), sensor: (body, isSensor) => Object.assign(body, { isSensor }), passes: (body, isPassed) => Object.assign(body, { isPassed }), moves: (body, vx, vy) => Object.assign(body, { vx, vy }),
        bounces: (body, restitution) => Object.assign(body, { restitution }), grow: (body, radius) => Object.assign(body, { radius, width: 2 * radius, height: 2 * radius }),
        step: (seconds, haptics) => haptics.step(seconds, () => advance(seconds)),
    };
}

export const drivers = { matter, planck, rapier2d: (...rest) => rapier('2d', ...rest), rapier3d: (...rest) => rapier('3d', ...rest), box2d3, velocities, cannon, havok: (...rest) => havok(false, ...rest), babylon: (...rest) => havok(true, ...rest), jolt, mujoco };
