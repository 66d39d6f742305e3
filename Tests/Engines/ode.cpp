// SPDX-License-Identifier: MIT
// ODE through its adapter.
#include "Scenes.h"
#include <cstdint>
#include <physvib/engines/physvib_ode.h>

struct Ode final : scenes::Engine {
    Ode() {
        dInitODE();
        joints = dJointGroupCreate(0);
    }
    void begin(double stepSeconds, double g, double e, bool hasFloor) override {
        dt = stepSeconds, elasticity = e;
        space = dSimpleSpaceCreate(nullptr); // the tests' process ends before it matters
        ode = dWorldCreate();
        dWorldSetGravity(ode, 0, -g, 0);
        balls.clear(), friction = 0;
        haptics.world = world, haptics.count = 0;
        if (hasFloor) dGeomSetData(dCreatePlane(space, 0, 1, 0, 0), reinterpret_cast<void*>(static_cast<std::intptr_t>(scenes::floorBody)));
    }
    void ball(double x, double y, double vx, double vy) override {
        dMass mass;
        dMassSetSphereTotal(&mass, scenes::massKg, scenes::radius);
        balls.push_back(dBodyCreate(ode));
        dBodySetMass(balls.back(), &mass);
        dBodySetPosition(balls.back(), x, y, 0);
        dBodySetLinearVel(balls.back(), vx, vy, 0);
        const dGeomID geom = dCreateSphere(space, scenes::radius);
        dGeomSetBody(geom, balls.back());
        dGeomSetData(geom, reinterpret_cast<void*>(balls.size()));
    }
    bool box(double x, double y, double width, double height, double w) override {
        dMass mass;
        dMassSetBoxTotal(&mass, 3.0, width, height, 1.0);
        balls.push_back(dBodyCreate(ode));
        dBodySetMass(balls.back(), &mass);
        dBodySetPosition(balls.back(), x, y, 0);
        dBodySetLinearVel(balls.back(), -w * y, 0, 0);
        dBodySetAngularVel(balls.back(), 0, 0, w);
        const dGeomID geom = dCreateBox(space, width, height, 1.0);
        dGeomSetBody(geom, balls.back());
        dGeomSetData(geom, reinterpret_cast<void*>(1));
        friction = 1.0;
        return true;
    }
    double spin() const override { return dBodyGetAngularVel(balls[0])[2]; }
    static void near(void* self, dGeomID a, dGeomID b) {
        Ode& engine = *static_cast<Ode*>(self);
        dContact contacts[4]{};
        const int count = dCollide(a, b, 4, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            dContact& contact = contacts[i];
            contact.surface.mode = dContactBounce;
            contact.surface.bounce = engine.elasticity;
            contact.surface.mu = engine.friction;
            const dJointID joint = dJointCreateContact(engine.ode, engine.joints, &contact);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
            physvib_ode_touch(&engine.haptics, joint, &contact.geom);
        }
    }
    void step() override {
        dSpaceCollide(space, this, near);
        if (physvib_ode_step(&haptics, ode, dt) != PHYSVIB_OK) std::printf("%s\n", haptics.error);
        dJointGroupEmpty(joints);
    }
    double height(int i) const override { return dBodyGetPosition(balls[static_cast<std::size_t>(i)])[1]; }
    double speed(int i) const override {
        dVector3 g;
        dWorldGetGravity(ode, g);
        return dBodyGetLinearVel(balls[static_cast<std::size_t>(i)])[g[1] < 0 ? 1 : 0];
    }
    double dt = 0, elasticity = 0, friction = 0;
    dWorldID ode = nullptr;
    dSpaceID space = nullptr;
    dJointGroupID joints = nullptr;
    physvib_ode haptics{};
    std::vector<dBodyID> balls;
};

int main() {
    Ode engine;
    return scenes::run("ODE", engine, true);
}
