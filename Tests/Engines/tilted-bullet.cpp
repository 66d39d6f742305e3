// SPDX-License-Identifier: MIT
// The tilted box through Bullet's adapter.
#include "TurnedBrick.h"
#include <memory>
#include <physvib/engines/physvib_bullet.h>

struct Bullet final : tilted::BrickEngine {
    ~Bullet() override { end(); }
    void begin(double stepSeconds) override {
        end();
        dt = stepSeconds;
        bullet = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
        bullet->setGravity({0, 0, 0});
        haptics = std::make_unique<PhysVibBullet>(*bullet, world);
    }
    void end() { haptics.reset(), bullet.reset(), bodies.clear(), shapes.clear(); } // in this order
    void wall(int id, const tilted::Vector& place, const tilted::Vector& normal) override {
        const btVector3 into = vector(normal);
        add(id, 0, std::make_unique<btStaticPlaneShape>(into, into.dot(vector(place))), {0, 0, 0});
    }
    void drop(const tilted::Vector& centre, const tilted::Vector& velocity) override {
        btRigidBody& body = add(tilted::ball, tilted::massKg,
                                std::make_unique<btSphereShape>(btScalar(tilted::radius)), vector(centre));
        body.setLinearVelocity(vector(velocity));
    }
    void throwBrick(const tilted::Brick& brick, const tilted::Vector& centre,
                    const tilted::Vector& velocity) override {
        btRigidBody& body = add(tilted::ball, tilted::massKg,
                                std::make_unique<btBoxShape>(vector(brick.halfMetres)), vector(centre));
        const auto& axis = brick.box.axis; // the columns of its matrix
        const btMatrix3x3 turned = btMatrix3x3(vector(axis[0]).x(), vector(axis[0]).y(), vector(axis[0]).z(),
                                               vector(axis[1]).x(), vector(axis[1]).y(), vector(axis[1]).z(),
                                               vector(axis[2]).x(), vector(axis[2]).y(), vector(axis[2]).z())
                                       .transpose();
        body.setCenterOfMassTransform(btTransform(turned, vector(centre)));
        body.setInterpolationWorldTransform(body.getWorldTransform());
        body.updateInertiaTensor();
        body.setLinearVelocity(vector(velocity));
    }
    btRigidBody& add(int id, double massKg, std::unique_ptr<btCollisionShape> shape, const btVector3& at) {
        btVector3 inertia(0, 0, 0);
        if (massKg > 0) shape->calculateLocalInertia(btScalar(massKg), inertia);
        bodies.push_back(std::make_unique<btRigidBody>(btScalar(massKg), nullptr, shape.get(), inertia));
        shapes.push_back(std::move(shape));
        btRigidBody& body = *bodies.back();
        body.setWorldTransform(btTransform(btQuaternion::getIdentity(), at));
        body.setInterpolationWorldTransform(body.getWorldTransform());
        body.setRestitution(massKg > 0 ? btScalar(tilted::restitution) : 1); // a pair's are products
        body.setFriction(0);
        body.setActivationState(DISABLE_DEACTIVATION);
        body.setUserIndex(id);
        bullet->addRigidBody(&body);
        return body;
    }
    static btVector3 vector(const tilted::Vector& v) {
        return {btScalar(v[0]), btScalar(v[1]), btScalar(v[2])};
    }
    static tilted::Vector vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
    void step() override { bullet->stepSimulation(btScalar(dt), 0); }
    tilted::Vector centre() const override { return vector(bodies.back()->getCenterOfMassPosition()); }
    tilted::Vector velocity() const override { return vector(bodies.back()->getLinearVelocity()); }
    double dt = 0;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    std::unique_ptr<btDiscreteDynamicsWorld> bullet;
    std::unique_ptr<PhysVibBullet> haptics;
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btRigidBody>> bodies; // the ball is the last
};

// Continuous collision: Bullet lets the gap close first, and bounces with what is left of the speed.
int continuous() {
    Bullet engine;
    engine.world = tilted::newWorld();
    engine.begin(1.0 / tilted::rate);
    engine.add(1, 0, std::make_unique<btBoxShape>(btVector3(0.5F, 2, 2)), {5, 0, 0});
    engine.drop({0, 0, 0}, {20, 0, 0});
    engine.bodies.back()->setCcdMotionThreshold(0.001F), engine.bodies.back()->setCcdSweptSphereRadius(0.04F);
    for (int i = 0; i < tilted::rate; ++i) engine.step();
    const double given = tilted::massKg * (20 - engine.velocity()[0]);
    const auto events = scenes::eventsOf(engine.world);
    const double felt = events.empty() ? 0 : events.front().impulse_n_s;
    std::printf("continuous: Bullet gave %.3f N s, felt %.3f\n", given, felt);
    return std::abs(felt / given - 1) < 0.03 ? 0 : 1;
}

int main() {
    Bullet engine;
    return tilted::run("Bullet", engine) | tilted::runBricks("Bullet", engine) | continuous();
}
