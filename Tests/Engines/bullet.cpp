// SPDX-License-Identifier: MIT
// Bullet through its adapter.
#include "Scenes.h"
#include <physvib/engines/physvib_bullet.h>
#include <memory>

struct Bullet final : scenes::Engine {
    void begin(double stepSeconds, double g, double e, bool hasFloor) override {
        dt = stepSeconds, elasticity = e;
        balls.clear(), haptics.reset(), world.reset(), shapes.clear(); // in this order
        world = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
        world->setGravity(vector(0, -g));
        haptics = std::make_unique<PhysVibBullet>(*world, this->Engine::world);
        if (hasFloor) body(0.0, new btBoxShape({5, 1, 5}), vector(0, -1), vector(0, 0));
    }
    void ball(double x, double y, double vx, double vy) override { balls.push_back(body(scenes::massKg, new btSphereShape(real(scenes::radius)), vector(x, y), vector(vx, vy))); }
    bool box(double x, double y, double width, double height, double w) override {
        btRigidBody* made = body(3.0, new btBoxShape({real(width / 2), real(height / 2), real(0.5)}), vector(x, y), vector(-w * y, 0));
        made->setAngularVelocity({0, 0, real(w)});
        made->setAngularFactor({0, 0, 1});
        made->setLinearFactor({1, 1, 0});
        made->setFriction(1);
        for (int i = 0; i < world->getNumCollisionObjects(); ++i) world->getCollisionObjectArray()[i]->setFriction(1);
        balls.push_back(made);
        return true;
    }
    double spin() const override { return at(0)->getAngularVelocity().z(); }
    static btScalar real(double value) { return static_cast<btScalar>(value); }
    static btVector3 vector(double x, double y) { return {real(x), real(y), 0}; }
    btRigidBody* body(double massKg, btCollisionShape* shape, const btVector3& place, const btVector3& velocity) {
        shapes.emplace_back(shape);
        btVector3 inertia(0, 0, 0);
        if (massKg > 0) shape->calculateLocalInertia(real(massKg), inertia);
        auto* added = new btRigidBody(real(massKg), nullptr, shape, inertia);
        added->setWorldTransform(btTransform(btQuaternion::getIdentity(), place));
        added->setLinearVelocity(velocity);
        added->setRestitution(massKg > 0 ? real(elasticity) : 1); // a pair's is the product
        added->setActivationState(DISABLE_DEACTIVATION);
        added->setUserIndex(massKg > 0 ? static_cast<int>(balls.size()) + 1 : 0);
        world->addRigidBody(added);
        return added;
    }
    void step() override { world->stepSimulation(real(dt), 0); }
    double height(int i) const override { return at(i)->getWorldTransform().getOrigin().y(); }
    double speed(int i) const override { return world->getGravity().y() < 0 ? at(i)->getLinearVelocity().y() : at(i)->getLinearVelocity().x(); }
    const btRigidBody* at(int i) const { return balls[static_cast<std::size_t>(i)]; }
    double dt = 0, elasticity = 0;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    std::unique_ptr<btDiscreteDynamicsWorld> world;
    std::unique_ptr<PhysVibBullet> haptics;
    std::vector<btRigidBody*> balls;
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
};

int main() {
    Bullet engine;
    return scenes::run("Bullet", engine, true);
}
