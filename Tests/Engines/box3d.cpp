// SPDX-License-Identifier: MIT
// Box3D through its adapter, in the scenes of the others. No Debian package has it: Tests/Engines/box3d.sh
// compiles it.
#include "Falls.h"
#include "Scenes.h"
#include <cstring>
#include <map>
#include <physvib/engines/physvib_box3d.h>

struct Box3d final : scenes::Engine {
    Box3d() {
        subSteps = 4, slowest = 60, handedOnPart = 0.05;
        verbs = "type put fling moves mass lockTurn gravityScale gravity remove passes sleep enable";
    }
    ~Box3d() override { end(); }
    void begin(double stepSeconds, double g, double e, double mu) override {
        end();
        dt = stepSeconds, elasticity = real(e), friction = real(mu);
        b3WorldDef def = b3DefaultWorldDef();
        def.gravity = vector(0, -g);
        def.enableSleep = false;
        def.enableContinuous = isContinuous;
        haptics = {};
        haptics.world = world;
        haptics.box3d = b3CreateWorld(&def);
    }
    void add(const scenes::Body& from) override {
        b3BodyDef def = b3DefaultBodyDef();
        def.type = static_cast<b3BodyType>(from.kind());
        def.position = {real(from.x), real(from.y), 0};
        // b3MakeQuatFromAxisAngle is off by up to 0.1 degrees
        def.rotation = {{0, 0, real(std::sin(from.angle / 2))}, real(std::cos(from.angle / 2))};
        def.linearVelocity = vector(from.vx, from.vy);
        def.angularVelocity = {0, 0, real(from.spin)};
        def.isBullet = from.isBullet;
        def.motionLocks.linearZ = def.motionLocks.angularX = def.motionLocks.angularY = true;
        def.motionLocks.angularZ = !from.turns;
        b3ShapeDef shape = b3DefaultShapeDef();
        shape.density = real(from.massKg / (from.isBox ? from.width * from.height
                                                       : 3.14159265358979 * std::pow(from.width, 3) / 6));
        shape.baseMaterial.restitution = elasticity, shape.baseMaterial.friction = friction;
        const b3BodyId body = bodies[from.id] = b3CreateBody(haptics.box3d, &def);
        const b3BoxHull box = b3MakeBoxHull(real(from.width / 2), real(from.height / 2), 0.5F);
        const b3Sphere ball = {{0, 0, 0}, real(from.width / 2)};
        if (from.isBox)
            b3CreateHullShape(body, &shape, &box.base);
        else
            b3CreateSphereShape(body, &shape, &ball);
        number(body, from.id, from.isSource);
    }
    static float real(double value) { return static_cast<float>(value); }
    static b3Vec3 vector(double x, double y) { return {real(x), real(y), 0}; }
    void feel(const scenes::Body& body) override { number(bodies.at(body.id), body.id, true); }
    void act(const std::string& verb, int id, double x, double y, double z) override {
        if (verb == "gravity") return b3World_SetGravity(haptics.box3d, vector(0, -x));
        const b3BodyId body = bodies.at(id);
        if (verb != "sleep" && verb != "enable") b3Body_SetAwake(body, true);
        if (verb == "type") b3Body_SetType(body, static_cast<b3BodyType>(x));
        if (verb == "put") b3Body_SetTransform(body, {real(x), real(y), 0}, b3Body_GetRotation(body));
        if (verb == "fling" || verb == "moves")
            b3Body_SetLinearVelocity(body, vector(x, y)), b3Body_SetAngularVelocity(body, {0, 0, real(z)});
        if (verb == "mass") {
            b3MassData data = b3Body_GetMassData(body);
            data.inertia = b3MulSM(real(x) / data.mass, data.inertia), data.mass = real(x);
            b3Body_SetMassData(body, data);
        }
        if (verb == "lockTurn") {
            b3MotionLocks locks = b3Body_GetMotionLocks(body);
            locks.angularZ = true;
            b3Body_SetMotionLocks(body, locks);
        }
        if (verb == "gravityScale") b3Body_SetGravityScale(body, real(x));
        if (verb == "enable") x != 0 ? b3Body_Enable(body) : b3Body_Disable(body);
        if (verb == "passes") {
            b3ShapeId shape;
            b3Body_GetShapes(body, &shape, 1);
            b3Filter filter = b3DefaultFilter();
            if (x != 0) filter.maskBits = 0;
            b3Shape_SetFilter(shape, filter, true);
        }
        if (verb == "sleep") b3World_EnableSleeping(haptics.box3d, true), b3Body_SetAwake(body, false);
        if (verb == "remove") physvib_box3d_remove(&haptics, body), b3DestroyBody(body);
    }
    std::string explain() override {
        char text[512];
        physvib_box3d_explain(&haptics, text, sizeof text);
        return text;
    }
    void number(b3BodyId which, int id, bool isSource) {
        if (physvib_box3d_set(&haptics, which, id, scenes::valuesOf(isSource)) != PHYSVIB_OK)
            std::fprintf(stderr, "%s\n", physvib_error());
    }
    void pin(int a, int b, double x, double y) override {
        const b3BodyDef still = b3DefaultBodyDef();
        b3RevoluteJointDef def = b3DefaultRevoluteJointDef();
        def.base.bodyIdA = bodies[a];
        def.base.bodyIdB = b > 0 ? bodies[b] : b3CreateBody(haptics.box3d, &still);
        const b3Pos at = {real(x), real(y), 0};
        def.base.localFrameA.p = b3Body_GetLocalPoint(def.base.bodyIdA, at);
        def.base.localFrameB.p = b3Body_GetLocalPoint(def.base.bodyIdB, at);
        def.base.constraintHertz = 240, def.base.constraintDampingRatio = 5; // pins that hold
        b3CreateRevoluteJoint(haptics.box3d, &def);
    }
    void oneWay(int body) override {
        platform = bodies[body];
        b3ShapeId shape;
        b3Body_GetShapes(platform, &shape, 1);
        b3Shape_EnablePreSolveEvents(shape, true); // where no callback is set, Box3D calls it all the same
        b3World_SetPreSolveCallback(haptics.box3d, pre, this);
    }
    static bool pre(b3ShapeId one, b3ShapeId two, b3Pos, b3Vec3, void* data) {
        const auto& self = *static_cast<Box3d*>(data);
        const b3BodyId a = b3Shape_GetBody(one), b = b3Shape_GetBody(two);
        if (!B3_ID_EQUALS(a, self.platform) && !B3_ID_EQUALS(b, self.platform)) return true;
        const b3BodyId other = B3_ID_EQUALS(a, self.platform) ? b : a;
        return !scenes::passes(b3Body_GetPosition(self.platform).y + 0.05, b3Body_GetPosition(other).y,
                               b3Body_GetLinearVelocity(other).y);
    }
    void step() override {
        if (physvib_box3d_step(&haptics, dt, subSteps) != PHYSVIB_OK)
            std::fprintf(stderr, "%s\n", haptics.error);
    }
    void end() {
        if (haptics.numbers != nullptr) b3DestroyWorld(haptics.box3d);
        physvib_box3d_free(&haptics);
        bodies.clear();
    }
    scenes::Motion motion(int id) const override {
        const b3BodyId body = bodies.at(id);
        const b3Pos at = b3Body_GetPosition(body);
        const b3Vec3 v = b3Body_GetLinearVelocity(body);
        const b3Quat turned = b3Body_GetRotation(body);
        return {static_cast<double>(at.x),         static_cast<double>(at.y),           v.x, v.y,
                b3Body_GetAngularVelocity(body).z, 2 * std::atan2(turned.v.z, turned.s)};
    }
    float elasticity = 0, friction = 0;
    physvib_box3d haptics{};
    std::map<int, b3BodyId> bodies;
    b3BodyId platform{};
};

int main(int count, char** words) {
    Box3d engine;
    if (count > 1 && std::strcmp(words[1], "falls") == 0) return scenes::falls("Box3D", engine) ? 0 : 1;
    return scenes::run("Box3D", engine, count, words);
}
