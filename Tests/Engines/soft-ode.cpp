// SPDX-License-Identifier: MIT
// ODE's contacts that are soft, and bodies that are destroyed between the search for contacts and the step.
#include "Trace.h"
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <physvib/engines/physvib_ode.h>

namespace {

constexpr double radius = 0.1, massKg = 1.0, fallMetres = 0.5, gravity = 9.81;

int failures = 0;

void expect(bool is, const char* what) {
    if (!is) std::printf("FAILED: %s\n", what), ++failures;
}

/// A ball or a leaning box above a floor.
struct Fall {
    explicit Fall(double step)
        : dt{step} {
        ode = dWorldCreate();
        dWorldSetGravity(ode, 0, -gravity, 0);
        space = dSimpleSpaceCreate(nullptr);
        joints = dJointGroupCreate(0);
        haptics->world = scenes::plainWorld();
        number(floor = dCreatePlane(space, 0, 1, 0, 0), 100);
        physvib_body known = scenes::valuesOf(true);
        known.mass_kg = massKg;
        physvib_world_set_body(haptics->world, 1, &known);
    }
    Fall(const Fall&) = delete;
    Fall& operator=(const Fall&) = delete;
    ~Fall() {
        dJointGroupDestroy(joints);
        dSpaceDestroy(space);
        dWorldDestroy(ode);
        physvib_world_free(haptics->world);
    }
    static void number(dGeomID geom, int id) {
        dGeomSetData(geom, reinterpret_cast<void*>(static_cast<std::intptr_t>(id)));
    }
    void add(dGeomID made, const dMass& mass, double height) {
        number(geom = made, 1);
        body = dBodyCreate(ode);
        dBodySetMass(body, &mass);
        dGeomSetBody(geom, body);
        dBodySetPosition(body, 0, height, 0);
        dBodySetLinearVel(body, 0, 0.5 * gravity * dt, 0); // ends of steps lie on the exact path
    }
    void addBall() {
        dMass mass;
        dMassSetSphereTotal(&mass, massKg, radius);
        add(dCreateSphere(space, radius), mass, radius + fallMetres);
    }
    static void near(void* self, dGeomID a, dGeomID b) {
        Fall& fall = *static_cast<Fall*>(self);
        dContact contacts[8];
        const int count = dCollide(a, b, 8, &contacts[0].geom, sizeof(dContact));
        for (int i = 0; i < count; ++i) {
            contacts[i].surface = fall.like.surface;
            const dJointID joint = dJointCreateContact(fall.ode, fall.joints, &contacts[i]);
            dJointAttach(joint, dGeomGetBody(a), dGeomGetBody(b));
            if (fall.isPlain)
                physvib_ode_touch(fall.haptics.get(), joint, &contacts[i].geom);
            else
                physvib_ode_touch_contact(fall.haptics.get(), joint, &contacts[i]);
        }
    }
    void step() {
        dSpaceCollide(space, this, near);
        if (between) between();
        expect(physvib_ode_step(haptics.get(), ode, dt) == PHYSVIB_OK, haptics->error);
        dJointGroupEmpty(joints);
    }
    /// Impulses felt in so many seconds.
    std::vector<double> felt(double seconds) {
        for (int i = 0; i * dt < seconds; ++i) step();
        std::vector<double> impulses;
        for (const auto& event : scenes::eventsOf(haptics->world)) impulses.push_back(event.impulse_n_s);
        return impulses;
    }
    double dt;
    dWorldID ode;
    dSpaceID space;
    dJointGroupID joints;
    dGeomID floor, geom = nullptr;
    dBodyID body = nullptr;
    dContact like{};
    bool isPlain = false; ///< the contacts' surfaces are not told
    std::function<void()> between;
    std::unique_ptr<physvib_ode> haptics = std::make_unique<physvib_ode>();
};

/// The first landing by the closed form, with springs of any stiffness.
void soft(int rate, double erp, double cfm, double bounce) {
    Fall fall{1.0 / rate};
    fall.like.surface.mode = dContactSoftERP | dContactSoftCFM | dContactBounce;
    fall.like.surface.soft_erp = erp, fall.like.surface.soft_cfm = cfm;
    fall.like.surface.bounce = bounce, fall.like.surface.bounce_vel = 0.1;
    fall.addBall();
    const double expected = massKg * std::sqrt(2 * gravity * fallMetres) * (1 + bounce);
    const auto impulses = fall.felt(0.45);
    const double part = impulses.empty() ? -1.0 : impulses.front() / expected - 1.0;
    std::printf("%4d/s, erp %.1f, cfm %.0e, bounce %.1f: %zu hits, %+.1f %%\n", rate, erp, cfm, bounce,
                impulses.size(), 100 * part);
    expect(std::fabs(part) < 0.05, "a soft landing is felt as its speed");
    expect(impulses.size() == 1, "one landing is one hit");
}

/// The corner of a leaning box: needs its moments of inertia.
void corner(int rate) {
    Fall fall{1.0 / rate};
    fall.like.surface.mode = dContactSoftERP | dContactSoftCFM;
    fall.like.surface.soft_erp = 0.5, fall.like.surface.soft_cfm = 1e-4;
    const double turn = 0.4, half = 0.1, lever = half * (std::cos(turn) - std::sin(turn));
    dMass mass;
    dMassSetBoxTotal(&mass, massKg, 2 * half, 2 * half, 2 * half);
    fall.add(dCreateBox(fall.space, 2 * half, 2 * half, 2 * half), mass,
             half * (std::cos(turn) + std::sin(turn)) + fallMetres);
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, 0, 0, 1, turn);
    dBodySetRotation(fall.body, turned);
    const double inertia = massKg * 8 * half * half / 12,
                 expected = std::sqrt(2 * gravity * fallMetres) / (1 / massKg + lever * lever / inertia);
    const auto impulses = fall.felt(0.335);
    if (!impulses.empty()) std::printf("corner: %+.1f %%\n", 100 * (impulses.front() / expected - 1));
    expect(!impulses.empty() && std::fabs(impulses.front() / expected - 1) < 0.05,
           "a soft corner is felt as its share");
}

/// The ball bounces, and is destroyed where it has just touched again.
void destroyed(bool isBodyToo) {
    Fall fall{1.0 / 240};
    fall.like.surface.mode = dContactBounce, fall.like.surface.bounce = 0.5;
    fall.addBall();
    int landings = 0;
    bool touched = false;
    fall.between = [&] {
        const bool touches = fall.haptics->count > 0;
        landings += touches && !touched ? 1 : 0;
        touched = touches;
        if (landings < 2 || fall.geom == nullptr) return;
        dGeomDestroy(fall.geom);
        if (isBodyToo) dBodyDestroy(fall.body);
        fall.geom = nullptr;
    };
    const auto impulses = fall.felt(0.9);
    expect(fall.geom == nullptr, "the ball has landed twice");
    expect(impulses.size() == (isBodyToo ? 1U : 2U), "what is gone is not felt, and a shape alone is");
}

void turning() {
    const dWorldID world = dWorldCreate();
    const dBodyID body = dBodyCreate(world);
    dMass mass;
    dMassSetBoxTotal(&mass, 2.0, 0.1, 0.2, 0.3);
    dBodySetMass(body, &mass);
    dMatrix3 turned;
    dRFromAxisAndAngle(turned, 1, 2, 3, 0.7);
    dBodySetRotation(body, turned);
    double found[6];
    physvib_ode_turning(body, found);
    constexpr int at[6][2]{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    for (int i = 0; i < 6; ++i) {
        double expected = 0;
        for (int k = 0; k < 3; ++k)
            expected += turned[4 * at[i][0] + k] * turned[4 * at[i][1] + k] / mass.I[4 * k + k];
        expect(std::fabs(found[i] - expected) < 1e-4 * found[0], "the inverse is that of the turned box");
    }
    dWorldDestroy(world);
}

} // namespace

int main() {
    dInitODE();
    for (const int rate : {60, 240})
        for (const double erp : {0.2, 0.8})
            for (const double cfm : {1e-5, 1e-3})
                for (const double bounce : {0.0, 0.5}) soft(rate, erp, cfm, bounce);
    corner(240);
    destroyed(true);
    destroyed(false);
    turning();
    std::printf("%d failures\n", failures);
    return failures == 0 ? 0 : 1;
}
