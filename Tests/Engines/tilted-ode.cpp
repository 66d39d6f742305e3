// SPDX-License-Identifier: MIT
// The tilted box through ODE's adapter.
#include "TurnedBrick.h"
#include <cstdint>
#include <physvib/engines/physvib_ode.h>

struct Ode final : tilted::BrickEngine {
    Ode() {
        dInitODE();
        joints = dJointGroupCreate(0);
    }
    void begin(double stepSeconds) override {
        dt = stepSeconds;
        space = dSimpleSpaceCreate(nullptr); // the process ends before it matters
        ode = dWorldCreate();
        haptics.world = world, haptics.count = 0;
    }
    void wall(int id, const tilted::Vector& place, const tilted::Vector& normal) override {
        number(dCreatePlane(space, normal[0], normal[1], normal[2], tilted::dot(place, normal)), id);
    }
    void drop(const tilted::Vector& centre, const tilted::Vector& velocity) override {
        dMass mass;
        dMassSetSphereTotal(&mass, tilted::massKg, tilted::radius);
        add(dCreateSphere(space, tilted::radius), mass, centre, velocity);
    }
    void throwBrick(const tilted::Brick& brick, const tilted::Vector& centre,
                    const tilted::Vector& velocity) override {
        const double x = 2 * brick.halfMetres[0], y = 2 * brick.halfMetres[1], z = 2 * brick.halfMetres[2];
        dMass mass;
        dMassSetBoxTotal(&mass, tilted::massKg, x, y, z);
        add(dCreateBox(space, x, y, z), mass, centre, velocity);
        const auto& axis = brick.box.axis; // the columns of its matrix
        const dMatrix3 turned{axis[0][0], axis[1][0], axis[2][0], 0,          axis[0][1], axis[1][1],
                              axis[2][1], 0,          axis[0][2], axis[1][2], axis[2][2], 0};
        dBodySetRotation(body, turned);
    }
    void add(dGeomID geom, const dMass& mass, const tilted::Vector& centre, const tilted::Vector& velocity) {
        number(geom, tilted::ball);
        body = dBodyCreate(ode);
        dBodySetMass(body, &mass);
        dGeomSetBody(geom, body);
        dBodySetPosition(body, centre[0], centre[1], centre[2]);
        dBodySetLinearVel(body, velocity[0], velocity[1], velocity[2]);
    }
    static void number(dGeomID geom, int id) {
        dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::intptr_t>(id)));
    }
    static void near(void* self, dGeomID a, dGeomID b) {
        Ode& engine = *static_cast<Ode*>(self);
        if (dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) return;
        dContact contact{};
        if (dCollide(a, b, 1, &contact.geom, sizeof(dContact)) == 0) return;
        contact.surface.mode = dContactBounce;
        contact.surface.bounce = tilted::restitution;
        const dJointID joint = dJointCreateContact(engine.ode, engine.joints, &contact);
        dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
        physvib_ode_touch(&engine.haptics, joint, &contact.geom);
    }
    void step() override {
        dSpaceCollide(space, this, near);
        if (physvib_ode_step(&haptics, ode, dt) != PHYSVIB_OK) std::puts(haptics.error);
        dJointGroupEmpty(joints);
    }
    static tilted::Vector vector(const dReal* v) { return {v[0], v[1], v[2]}; }
    tilted::Vector centre() const override { return vector(dBodyGetPosition(body)); }
    tilted::Vector velocity() const override { return vector(dBodyGetLinearVel(body)); }
    double dt = 0;
    dWorldID ode = nullptr;
    dSpaceID space = nullptr;
    dJointGroupID joints = nullptr;
    dBodyID body = nullptr;
    physvib_ode haptics{};
};

int main() {
    Ode engine;
    return tilted::run("ODE", engine) | tilted::runBricks("ODE", engine);
}
