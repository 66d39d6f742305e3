// SPDX-License-Identifier: MIT
// Chipmunk through its adapter.
#include "Scenes.h"
#include <chipmunk/chipmunk.h>
#include <cstdint>
#include <map>
extern "C" {
#include <physvib/engines/physvib_chipmunk.h>
}

struct Chipmunk final : scenes::Engine {
    Chipmunk() {
        movesFirst = true;
        verbs = "type put fling moves mass lockTurn gravity remove sensor passes sleep";
    }
    void begin(double stepSeconds, double g, double e, double mu) override {
        dt = stepSeconds, elasticity = e, friction = mu, platform = nullptr;
        space = cpSpaceNew(); // the tests' process ends before it matters
        cpSpaceSetGravity(space, cpv(0, -g));
        cpSpaceSetIterations(space, 30);
        cpSpaceSetCollisionSlop(space, 0.001);
        bodies.clear();
        bodies[0] = cpSpaceGetStaticBody(space);
        physvib_chipmunk_attach(space, world);
    }
    void floor() override {
        shape(cpSegmentShapeNew(bodies[0], cpv(-20, 0), cpv(20, 0), 0), scenes::floorBody, false);
    }
    void tiles(double left, double right, int count) override {
        const double width = (right - left) / count;
        for (int i = 0; i < count; ++i) {
            const cpVect from = cpv(left + i * width, 0), to = cpv(left + (i + 1) * width, 0);
            cpShape* tile = cpSegmentShapeNew(bodies[0], from, to, 0);
            cpSegmentShapeSetNeighbors(tile, cpv(from.x - width, 0), cpv(to.x + width, 0));
            shape(tile, scenes::floorBody, false);
        }
    }
    void add(const scenes::Body& from) override {
        tell(from);
        cpBody* body = from.moves() ? cpBodyNew(from.massKg, from.turns ? from.inertia() : INFINITY)
                       : from.type == scenes::Type::kinematic ? cpBodyNewKinematic()
                                                              : cpBodyNewStatic();
        cpSpaceAddBody(space, body);
        cpBodySetPosition(body, cpv(from.x, from.y));
        cpBodySetAngle(body, from.angle);
        if (cpBodyGetType(body) != CP_BODY_TYPE_STATIC)
            cpBodySetVelocity(body, cpv(from.vx, from.vy)), cpBodySetAngularVelocity(body, from.spin);
        bodies[from.id] = body;
        made[from.id] = from;
        shape(from.isBox ? cpBoxShapeNew(body, from.width, from.height, 0)
                         : cpCircleShapeNew(body, from.width / 2, cpvzero),
              from.id, from.moves());
        if (from.isSensor) act("sensor", from.id, 1, 0, 0);
    }
    void shape(cpShape* added, int id, bool moves) { // a pair's are products
        cpShapeSetElasticity(cpSpaceAddShape(space, added), moves ? elasticity : 1.0);
        cpShapeSetFriction(added, std::sqrt(friction));
        cpShapeSetUserData(added, reinterpret_cast<void*>(static_cast<std::intptr_t>(id)));
    }
    void pin(int a, int b, double x, double y) override {
        cpConstraintSetCollideBodies(
            cpSpaceAddConstraint(space, cpPivotJointNew(bodies[a], bodies[b], cpv(x, y))), cpFalse);
    }
    void oneWay(int body) override {
        platform = bodies[body];
        cpCollisionHandler* handler = cpSpaceAddDefaultCollisionHandler(space);
        handler->userData = this;
        handler->preSolveFunc = [](cpArbiter* arbiter, cpSpace* in, cpDataPointer data) {
            const Chipmunk& self = *static_cast<Chipmunk*>(data);
            CP_ARBITER_GET_BODIES(arbiter, a, b);
            cpBody* other = a == self.platform ? b : a;
            if ((a == self.platform || b == self.platform) &&
                scenes::passes(cpBodyGetPosition(self.platform).y + 0.05, cpBodyGetPosition(other).y,
                               cpBodyGetVelocity(other).y))
                return cpArbiterIgnore(arbiter);
            return physvib_chipmunk_look(arbiter, in, self.world);
        };
        handler->postSolveFunc = [](cpArbiter* arbiter, cpSpace* in, cpDataPointer data) {
            physvib_chipmunk_push(arbiter, in, static_cast<Chipmunk*>(data)->world);
        };
    }
    void step() override {
        if (physvib_chipmunk_step(space, world, dt) != PHYSVIB_OK)
            std::fprintf(stderr, "%s\n", physvib_chipmunk_error);
    }
    void act(const std::string& verb, int id, double x, double y, double z) override {
        if (verb == "gravity") return cpSpaceSetGravity(space, cpv(0, -x));
        cpBody* body = bodies.at(id);
        if (verb == "type") {
            constexpr cpBodyType types[]{CP_BODY_TYPE_STATIC, CP_BODY_TYPE_KINEMATIC, CP_BODY_TYPE_DYNAMIC};
            cpBodySetType(body, types[static_cast<int>(x)]);
            if (x == 2) cpBodySetMass(body, made[id].massKg), cpBodySetMoment(body, made[id].inertia());
        } else if (verb == "put") {
            cpBodySetPosition(body, cpv(x, y));
            cpSpaceReindexShapesForBody(space, body);
        } else if (verb == "fling" || verb == "moves") {
            cpBodySetVelocity(body, cpv(x, y)), cpBodySetAngularVelocity(body, z);
        } else if (verb == "mass") {
            cpBodySetMass(body, x);
        } else if (verb == "lockTurn") {
            cpBodySetMoment(body, INFINITY);
        } else if (verb == "sleep") {
            cpSpaceSetSleepTimeThreshold(space, 100);
            cpBodySleep(body);
        } else {
            act(verb, body, x != 0);
        }
    }
    void act(const std::string& verb, cpBody* body, bool is) {
        std::pair<const std::string&, bool> how{verb, is};
        cpBodyEachShape(
            body,
            [](cpBody*, cpShape* shape, void* data) {
                const auto& [what, yes] = *static_cast<decltype(how)*>(data);
                if (what == "sensor") cpShapeSetSensor(shape, yes);
                if (what == "passes")
                    cpShapeSetFilter(shape, yes ? CP_SHAPE_FILTER_NONE : CP_SHAPE_FILTER_ALL);
                if (what == "remove") cpSpaceRemoveShape(cpShapeGetSpace(shape), shape);
            },
            &how);
        if (verb == "remove") cpSpaceRemoveBody(space, body);
    }
    std::string explain() override {
        char text[512];
        physvib_chipmunk_explain(space, world, text, sizeof text);
        return text;
    }
    scenes::Motion motion(int id) const override {
        const cpBody* body = bodies.at(id);
        const cpVect at = cpBodyGetPosition(body), v = cpBodyGetVelocity(body);
        return {at.x, at.y, v.x, v.y, cpBodyGetAngularVelocity(body), cpBodyGetAngle(body)};
    }
    double elasticity = 0, friction = 0;
    cpSpace* space = nullptr;
    cpBody* platform = nullptr;
    std::map<int, cpBody*> bodies;
    std::map<int, scenes::Body> made;
};

int main(int count, char** words) {
    Chipmunk engine;
    return scenes::run("Chipmunk", engine, count, words);
}
