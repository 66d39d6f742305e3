// SPDX-License-Identifier: MIT
// Chipmunk through its adapter.
#include "Scenes.h"
#include <chipmunk/chipmunk.h>
#include <cstdint>
extern "C" {
#include <physvib/engines/physvib_chipmunk.h>
}

struct Chipmunk final : scenes::Engine {
    Chipmunk() { movesFirst = true; }
    void begin(double stepSeconds, double g, double e, bool hasFloor) override {
        dt = stepSeconds, elasticity = e;
        space = cpSpaceNew(); // the tests' process ends before it matters
        cpSpaceSetGravity(space, cpv(0, -g));
        cpSpaceSetIterations(space, 30);
        cpSpaceSetCollisionSlop(space, 0.001);
        balls.clear();
        if (hasFloor) shape(cpSegmentShapeNew(cpSpaceGetStaticBody(space), cpv(-5, 0), cpv(5, 0), 0), scenes::floorBody);
        physvib_chipmunk_attach(space, world);
    }
    void ball(double x, double y, double vx, double vy) override {
        cpBody* body = cpSpaceAddBody(space, cpBodyNew(scenes::massKg, cpMomentForCircle(scenes::massKg, 0, scenes::radius, cpvzero)));
        cpBodySetPosition(body, cpv(x, y));
        cpBodySetVelocity(body, cpv(vx, vy));
        balls.push_back(body);
        shape(cpCircleShapeNew(body, scenes::radius, cpvzero), static_cast<int>(balls.size()));
    }
    bool box(double x, double y, double width, double height, double w) override {
        cpBody* body = cpSpaceAddBody(space, cpBodyNew(3.0, cpMomentForBox(3.0, width, height)));
        cpBodySetPosition(body, cpv(x, y));
        cpBodySetAngularVelocity(body, w);
        cpBodySetVelocity(body, cpv(-w * y, 0)); // about its foot
        balls.push_back(body);
        shape(cpBoxShapeNew(body, width, height, 0), 1);
        cpSpaceEachShape(space, [](cpShape* each, void*) { cpShapeSetFriction(each, 1.0); }, nullptr);
        return true;
    }
    double spin() const override { return cpBodyGetAngularVelocity(balls[0]); }
    void shape(cpShape* added, int id) {
        cpShapeSetElasticity(cpSpaceAddShape(space, added), id == scenes::floorBody ? 1.0 : elasticity); // a pair's is the product
        cpShapeSetUserData(added, reinterpret_cast<void*>(static_cast<std::intptr_t>(id)));
    }
    void step() override {
        if (physvib_chipmunk_step(space, world, dt) != PHYSVIB_OK) std::printf("%s\n", physvib_chipmunk_error);
    }
    double height(int i) const override { return cpBodyGetPosition(balls[static_cast<std::size_t>(i)]).y; }
    double speed(int i) const override {
        const cpVect v = cpBodyGetVelocity(balls[static_cast<std::size_t>(i)]);
        return cpSpaceGetGravity(space).y < 0 ? v.y : v.x;
    }
    double dt = 0, elasticity = 0;
    cpSpace* space = nullptr;
    std::vector<cpBody*> balls;
};

int main() {
    Chipmunk engine;
    return scenes::run("Chipmunk", engine, true);
}
