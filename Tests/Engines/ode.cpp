// SPDX-License-Identifier: MIT
// ODE through its adapter.
#include "Scenes.h"
#include <cstdint>
#include <map>
#include <physvib/engines/physvib_ode.h>

struct Ode final : scenes::Engine {
    Ode() {
        verbs = "type put fling moves mass lockTurn gravity remove passes sleep";
        dInitODE();
        joints = dJointGroupCreate(0);
    }
    void begin(double stepSeconds, double g, double e, double mu) override {
        dt = stepSeconds, elasticity = e, friction = mu, platform = nullptr;
        space = dSimpleSpaceCreate(nullptr); // the tests' process ends before it matters
        ode = dWorldCreate();
        dWorldSetGravity(ode, 0, -g, 0);
        bodies.clear();
        haptics.world = world, haptics.count = 0;
    }
    void floor() override {
        dGeomSetData(dCreatePlane(space, 0, 1, 0, 0),
                     reinterpret_cast<void*>(static_cast<std::intptr_t>(scenes::floorBody)));
    }
    void add(const scenes::Body& from) override {
        tell(from);
        const dGeomID geom = from.isBox ? dCreateBox(space, from.width, from.height, 1.0)
                                        : dCreateSphere(space, from.width / 2);
        dMatrix3 turned;
        dRFromAxisAndAngle(turned, 0, 0, 1, from.angle);
        dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::intptr_t>(from.id)));
        if (from.moves() || from.type == scenes::Type::kinematic) fall(from, geom);
        dGeomSetPosition(geom, from.x, from.y, 0);
        dGeomSetRotation(geom, turned);
        geoms[from.id] = geom;
        made[from.id] = from;
    }
    void fall(const scenes::Body& from, dGeomID geom) {
        const dBodyID body = bodies[from.id] = dBodyCreate(ode);
        weigh(from, body, from.massKg > 0 ? from.massKg : 1.0);
        if (from.type == scenes::Type::kinematic) dBodySetKinematic(body);
        dGeomSetBody(geom, body);
        dBodySetLinearVel(body, from.vx, from.vy, 0);
        dBodySetAngularVel(body, 0, 0, from.spin);
        const dJointID plane = dJointCreatePlane2D(ode, nullptr);
        dJointAttach(plane, body, nullptr);
    }
    static void weigh(const scenes::Body& from, dBodyID body, double kg) {
        dMass mass;
        if (from.isBox)
            dMassSetBoxTotal(&mass, kg, from.width, from.height, 1.0);
        else
            dMassSetSphereTotal(&mass, kg, from.width / 2);
        if (!from.turns) mass.I[10] = 1e9;
        dBodySetMass(body, &mass);
    }
    void act(const std::string& verb, int id, double x, double y, double z) override {
        if (verb == "gravity") return dWorldSetGravity(ode, 0, -x, 0);
        const dGeomID geom = geoms.at(id);
        const dBodyID body = dGeomGetBody(geom);
        scenes::Body& from = made[id];
        if (body != nullptr && verb != "sleep") dBodyEnable(body);
        if (verb == "put") {
            dGeomSetPosition(geom, x, y, 0);
        } else if (verb == "fling" || verb == "moves") {
            dBodySetLinearVel(body, x, y, 0), dBodySetAngularVel(body, 0, 0, z);
        } else if (verb == "mass") {
            weigh(from, body, x);
        } else if (verb == "lockTurn") {
            from.turns = false;
            weigh(from, body, from.massKg);
        } else if (verb == "passes") {
            dGeomSetCollideBits(geom, x != 0 ? 0 : ~0UL), dGeomSetCategoryBits(geom, x != 0 ? 0 : ~0UL);
        } else if (verb == "sleep") {
            dBodyDisable(body);
        } else if (verb == "type") {
            const dReal at[]{dGeomGetPosition(geom)[0], dGeomGetPosition(geom)[1]};
            if (body != nullptr) dGeomSetBody(geom, nullptr), dBodyDestroy(body), bodies.erase(id);
            from.type = static_cast<scenes::Type>(x);
            if (from.type != scenes::Type::fixed) fall(from, geom);
            dGeomSetPosition(geom, at[0], at[1], 0);
        } else { // remove
            dGeomDestroy(geom);
            if (body != nullptr) dBodyDestroy(body);
        }
    }
    void pin(int a, int b, double x, double y) override {
        const dJointID hinge = dJointCreateHinge(ode, nullptr);
        dJointAttach(hinge, bodies[a], b > 0 ? bodies[b] : nullptr);
        dJointSetHingeAnchor(hinge, x, y, 0);
        dJointSetHingeAxis(hinge, 0, 0, 1);
    }
    void oneWay(int body) override { platform = geoms[body]; }
    bool isPassed(dGeomID a, dGeomID b) const {
        const dBodyID a1 = dGeomGetBody(a), b1 = dGeomGetBody(b);
        if (a1 != nullptr && b1 != nullptr && dAreConnected(a1, b1)) return true; // by a pin
        if (platform == nullptr || (a != platform && b != platform)) return false;
        const dBodyID other = a == platform ? b1 : a1;
        return scenes::passes(dGeomGetPosition(platform)[1] + 0.05, dBodyGetPosition(other)[1],
                              dBodyGetLinearVel(other)[1]);
    }
    static void near(void* self, dGeomID a, dGeomID b) {
        Ode& engine = *static_cast<Ode*>(self);
        if ((dGeomGetBody(a) == nullptr && dGeomGetBody(b) == nullptr) || engine.isPassed(a, b)) return;
        dContact contacts[8]{};
        const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            dContact& contact = contacts[i];
            contact.surface.mode = dContactBounce | dContactApprox1; // friction in parts of what presses
            contact.surface.bounce = engine.elasticity;
            contact.surface.mu = engine.friction;
            const dJointID joint = dJointCreateContact(engine.ode, engine.joints, &contact);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
            physvib_ode_touch(&engine.haptics, joint, &contact.geom);
        }
    }
    void step() override {
        dSpaceCollide(space, this, near);
        if (physvib_ode_step(&haptics, ode, dt) != PHYSVIB_OK) std::fprintf(stderr, "%s\n", haptics.error);
        dJointGroupEmpty(joints);
    }
    scenes::Motion motion(int id) const override {
        const auto known = bodies.find(id);
        if (known == bodies.end()) {
            const dReal* still = dGeomGetPosition(geoms.at(id));
            return {still[0], still[1], 0, 0, 0, made.at(id).angle};
        }
        const dBodyID body = known->second;
        const dReal *at = dBodyGetPosition(body), *v = dBodyGetLinearVel(body),
                    *turned = dBodyGetRotation(body);
        return {at[0], at[1], v[0], v[1], dBodyGetAngularVel(body)[2], std::atan2(turned[4], turned[0])};
    }
    double elasticity = 0, friction = 0;
    dWorldID ode = nullptr;
    dSpaceID space = nullptr;
    dJointGroupID joints = nullptr;
    dGeomID platform = nullptr;
    physvib_ode haptics{};
    std::map<int, dBodyID> bodies;
    std::map<int, dGeomID> geoms;
    std::map<int, scenes::Body> made;
};

int main(int count, char** words) {
    Ode engine;
    const int isPlane = engine.haptics.is_plane = scenes::isPlane(count, words) ? 1 : 0;
    return scenes::run("ODE", engine, count - isPlane, words + isPlane);
}
