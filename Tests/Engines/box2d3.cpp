// SPDX-License-Identifier: MIT
// Box2D 3 through its adapter, in the scenes of the others. No Debian package has it: Tests/Engines/box2d3.sh
// compiles it.
#include "Falls.h"
#include "Scenes.h"
#include <cstring>
#include <map>
#include <physvib/engines/physvib_box2d3.h>

struct Box2d3 final : scenes::Engine {
    Box2d3() {
        subSteps = 4, slowest = 60, handedOnPart = 0.05, isKicked = false;
        verbs = "type put fling moves mass lockTurn gravityScale gravity remove passes sleep enable";
    }
    ~Box2d3() override { end(); }
    void begin(double stepSeconds, double g, double e, double mu) override {
        end();
        dt = stepSeconds, elasticity = static_cast<float>(e), friction = static_cast<float>(mu);
        b2WorldDef def = b2DefaultWorldDef();
        def.gravity = {0, static_cast<float>(-g)};
        def.enableSleep = false;
#if defined(b2_maxPolygonVertices)
        def.enableContinous = isContinuous;
#else
        def.enableContinuous = isContinuous;
#endif
        haptics = {};
        haptics.world = world;
        haptics.box2d = b2CreateWorld(&def);
    }
    void tiles(double left, double right, int count) override {
        std::vector<b2Vec2> points;
        // two ghosts
        for (int i = count + 1; i >= -1; --i)
            points.push_back({static_cast<float>(left + (right - left) * i / count), 0});
        const b2BodyDef still = b2DefaultBodyDef();
        const b2BodyId ground = b2CreateBody(haptics.box2d, &still);
        b2ChainDef chain = b2DefaultChainDef();
        chain.points = points.data(), chain.count = count + 3;
#if defined(b2_maxPolygonVertices)
        chain.friction = friction;
#else
        b2SurfaceMaterial material = b2DefaultSurfaceMaterial();
        material.friction = friction;
        chain.materials = &material, chain.materialCount = 1;
#endif
        b2CreateChain(ground, &chain);
        number(ground, scenes::floorBody, false);
    }
    void add(const scenes::Body& from) override {
        b2BodyDef def = b2DefaultBodyDef();
        def.type = static_cast<b2BodyType>(from.kind());
        def.position = {static_cast<float>(from.x), static_cast<float>(from.y)};
        // b2MakeRot of 3.1 is off by up to 0.1 degrees
        def.rotation = {std::cos(static_cast<float>(from.angle)), std::sin(static_cast<float>(from.angle))};
        def.linearVelocity = {static_cast<float>(from.vx), static_cast<float>(from.vy)};
        def.angularVelocity = static_cast<float>(from.spin);
        def.isBullet = from.isBullet;
        const double area =
            from.isBox ? from.width * from.height : 3.14159265358979 * from.width * from.width / 4;
        b2ShapeDef shape = b2DefaultShapeDef();
        shape.density = static_cast<float>(from.massKg / area);
        shape.enablePreSolveEvents = true;
#if defined(b2_maxPolygonVertices)
        shape.restitution = elasticity, shape.friction = friction;
#else
        shape.material.restitution = elasticity, shape.material.friction = friction;
#endif
        const b2BodyId body = bodies[from.id] = b2CreateBody(haptics.box2d, &def);
        const b2Polygon box =
            b2MakeBox(static_cast<float>(from.width / 2), static_cast<float>(from.height / 2));
        const b2Circle disc = {{0, 0}, static_cast<float>(from.width / 2)};
        if (from.isBox)
            b2CreatePolygonShape(body, &shape, &box);
        else
            b2CreateCircleShape(body, &shape, &disc);
        if (!from.turns) lockTurn(body);
        number(body, from.id, from.isSource);
    }
    static void lockTurn(b2BodyId body) {
#if defined(B2_NULL_INDEX)
        b2MotionLocks locks{};
        locks.angularZ = true;
        b2Body_SetMotionLocks(body, locks);
#else
        b2Body_SetFixedRotation(body, true);
#endif
    }
    void feel(const scenes::Body& body) override { number(bodies.at(body.id), body.id, true); }
    void act(const std::string& verb, int id, double x, double y, double z) override {
        const b2Vec2 at{static_cast<float>(x), static_cast<float>(y)};
        if (verb == "gravity") return b2World_SetGravity(haptics.box2d, {0, -at.x});
        const b2BodyId body = bodies.at(id);
        if (verb != "sleep" && verb != "enable") b2Body_SetAwake(body, true);
        if (verb == "type") b2Body_SetType(body, static_cast<b2BodyType>(x));
        if (verb == "put") b2Body_SetTransform(body, {at.x, at.y}, b2Body_GetRotation(body));
        if (verb == "fling" || verb == "moves")
            b2Body_SetLinearVelocity(body, at), b2Body_SetAngularVelocity(body, static_cast<float>(z));
        if (verb == "mass") {
            b2MassData data = b2Body_GetMassData(body);
            data.rotationalInertia *= at.x / data.mass, data.mass = at.x;
            b2Body_SetMassData(body, data);
        }
        if (verb == "lockTurn") lockTurn(body);
        if (verb == "gravityScale") b2Body_SetGravityScale(body, at.x);
        if (verb == "enable") x != 0 ? b2Body_Enable(body) : b2Body_Disable(body);
        if (verb == "passes") {
            b2ShapeId shape;
            b2Body_GetShapes(body, &shape, 1);
            b2Filter filter = b2DefaultFilter();
            if (x != 0) filter.maskBits = 0;
            b2Shape_SetFilter(shape, filter);
        }
        if (verb == "sleep") b2World_EnableSleeping(haptics.box2d, true), b2Body_SetAwake(body, false);
        if (verb == "remove") physvib_box2d3_remove(&haptics, body), b2DestroyBody(body);
    }
    std::string explain() override {
        char text[512];
        physvib_box2d3_explain(&haptics, text, sizeof text);
        return text;
    }
    void number(b2BodyId which, int id, bool isSource) {
        if (physvib_box2d3_set(&haptics, which, id, scenes::valuesOf(isSource)) != PHYSVIB_OK)
            std::fprintf(stderr, "%s\n", physvib_error());
    }
    void pin(int a, int b, double x, double y) override {
        const b2BodyDef still = b2DefaultBodyDef();
        const b2BodyId first = bodies[a], second = b > 0 ? bodies[b] : b2CreateBody(haptics.box2d, &still);
        b2RevoluteJointDef def = b2DefaultRevoluteJointDef();
#if defined(B2_NULL_INDEX)
        const b2Pos at = {static_cast<float>(x), static_cast<float>(y)};
        def.base.bodyIdA = first, def.base.bodyIdB = second;
        def.base.localFrameA.p = b2Body_GetLocalPoint(first, at),
        def.base.localFrameB.p = b2Body_GetLocalPoint(second, at);
        def.base.constraintHertz = 240, def.base.constraintDampingRatio = 5; // pins that hold
#else
        const b2Vec2 at = {static_cast<float>(x), static_cast<float>(y)};
        def.bodyIdA = first, def.bodyIdB = second;
        def.localAnchorA = b2Body_GetLocalPoint(first, at),
        def.localAnchorB = b2Body_GetLocalPoint(second, at);
#endif
        b2CreateRevoluteJoint(haptics.box2d, &def);
    }
    void oneWay(int body) override {
        platform = bodies[body];
#if defined(B2_NULL_INDEX)
        b2World_SetPreSolveCallback(haptics.box2d, pre, nullptr, this);
#else
        b2World_SetPreSolveCallback(haptics.box2d, pre, this);
#endif
    }
#if defined(B2_NULL_INDEX)
    static void pre(b2ShapeId a, b2ShapeId b, b2Manifold* manifold, void* self) {
        if (!static_cast<Box2d3*>(self)->isSolid(a, b)) manifold->pointCount = 0;
    }
#else
    static bool pre(b2ShapeId a, b2ShapeId b, b2Manifold*, void* self) {
        return static_cast<Box2d3*>(self)->isSolid(a, b);
    }
#endif
    bool isSolid(b2ShapeId one, b2ShapeId two) const {
        const b2BodyId a = b2Shape_GetBody(one), b = b2Shape_GetBody(two);
        if (!B2_ID_EQUALS(a, platform) && !B2_ID_EQUALS(b, platform)) return true;
        const b2BodyId other = B2_ID_EQUALS(a, platform) ? b : a;
        return !scenes::passes(b2Body_GetPosition(platform).y + 0.05, b2Body_GetPosition(other).y,
                               b2Body_GetLinearVelocity(other).y);
    }
    void step() override {
        if (physvib_box2d3_step(&haptics, dt, 4) != PHYSVIB_OK) std::fprintf(stderr, "%s\n", haptics.error);
    }
    void end() {
        if (haptics.numbers != nullptr) b2DestroyWorld(haptics.box2d);
        physvib_box2d3_free(&haptics);
        bodies.clear();
    }
    scenes::Motion motion(int id) const override {
        const b2BodyId body = bodies.at(id);
        const auto at = b2Body_GetPosition(body);
        const b2Vec2 v = b2Body_GetLinearVelocity(body);
        return {static_cast<double>(at.x),
                static_cast<double>(at.y),
                v.x,
                v.y,
                b2Body_GetAngularVelocity(body),
                b2Rot_GetAngle(b2Body_GetRotation(body))};
    }
    float elasticity = 0, friction = 0;
    physvib_box2d3 haptics{};
    std::map<int, b2BodyId> bodies;
    b2BodyId platform{};
};

/// 150 balls fall onto a tray that moves, and one of them has no number for a second: its error is told once,
/// and the others are felt.
static bool tray(Box2d3& engine) {
    constexpr int trayBody = 1, firstBall = 1000, balls = 150, second = 60;
    engine.world = scenes::plainWorld();
    engine.begin(1.0 / second, scenes::gravity, 0.0, 0.5);
    engine.add({.id = trayBody, .isBox = true, .y = -0.5, .width = 40.0, .height = 1.0, .massKg = 0.0});
    b2Body_SetType(engine.bodies[trayBody], b2_kinematicBody);
    b2Body_SetLinearVelocity(engine.bodies[trayBody], {0.5F, 0.0F});
    for (int i = 0; i < balls; ++i)
        engine.add(
            {.id = firstBall + i, .x = 0.25 * (i - balls / 2), .y = 0.3 + 0.002 * i, .isSource = true});
    const b2BodyId odd = engine.bodies[firstBall];
    physvib_box2d3_remove(&engine.haptics, odd);
    int told = 0, lasting = 0;
    for (int step = 0; step < 2 * second; ++step) {
        if (step == second) engine.number(odd, firstBall, true);
        told += physvib_box2d3_step(&engine.haptics, engine.dt, engine.subSteps) != PHYSVIB_OK ? 1 : 0;
        lasting += engine.haptics.code != PHYSVIB_OK ? 1 : 0;
    }
    const bool isHealed = engine.haptics.code == PHYSVIB_OK && b2Body_IsValid(odd);
    const auto events = engine.take();
    physvib_world_free(engine.world);
    const bool isFine = told == 1 && lasting > second / 2 && isHealed && events.size() >= balls - 1;
    std::printf("Box2D 3,60,tray: %zu events of %d balls, an error of %d steps told %d times%s\n",
                events.size(), balls, lasting, told, isFine ? "" : ",FAILED");
    return isFine;
}

int main(int count, char** words) {
    Box2d3 engine;
    if (count > 1 && std::strcmp(words[1], "falls") == 0) return scenes::falls("Box2D 3", engine) ? 0 : 1;
    if (count > 1) return scenes::run("Box2D 3", engine, count, words);
    const bool isTrayFine = tray(engine);
    return scenes::run("Box2D 3", engine, count, words) == 0 && isTrayFine ? 0 : 1;
}
