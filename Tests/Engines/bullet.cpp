// SPDX-License-Identifier: MIT
// Bullet through its adapter.
#include "Scenes.h"
#include <map>
#include <memory>
#include <physvib/engines/physvib_bullet.h>

struct Bullet final : scenes::Engine {
    Bullet() { verbs = "type put fling moves mass lockTurn gravityScale gravity remove sensor passes sleep"; }
    ~Bullet() override { end(); }
    void begin(double stepSeconds, double g, double e, double mu) override {
        end();
        dt = stepSeconds, elasticity = e, friction = mu;
        bullet = std::make_unique<btDiscreteDynamicsWorld>(&dispatcher, &broadphase, &solver, &configuration);
        bullet->setGravity(vector(0, -g));
        haptics = std::make_unique<PhysVibBullet>(*bullet, world, contacts);
    }
    // in this order
    void end() {
        bodies.clear(), moved.clear(), joints.clear(), haptics.reset(), bullet.reset(), shapes.clear(),
            platform = nullptr;
    }
    void add(const scenes::Body& from) override {
        tell(from);
        if (from.isBox)
            shapes.push_back(std::make_unique<btBoxShape>(
                btVector3(real(from.width / 2), real(from.height / 2), real(0.5))));
        else
            shapes.push_back(std::make_unique<btSphereShape>(real(from.width / 2)));
        btVector3 inertia(0, 0, 0);
        if (from.moves()) shapes.back()->calculateLocalInertia(real(from.massKg), inertia);
        if (from.isBox && from.moves()) inertia.setZ(real(from.inertia()));
        auto* body =
            new btRigidBody(real(from.moves() ? from.massKg : 0), nullptr, shapes.back().get(), inertia);
        if (from.type == scenes::Type::kinematic)
            body->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT);
        body->setWorldTransform(
            btTransform(btQuaternion(btVector3(0, 0, 1), real(from.angle)), vector(from.x, from.y)));
        body->setInterpolationWorldTransform(body->getWorldTransform());
        body->setLinearVelocity(vector(from.vx, from.vy));
        body->setAngularVelocity({0, 0, real(from.spin)});
        body->setLinearFactor({1, 1, 0});
        body->setAngularFactor({0, 0, from.turns ? real(1) : 0});
        body->setRestitution(from.moves() ? real(elasticity) : 1); // a pair's are products
        body->setFriction(real(std::sqrt(friction)));
        body->setActivationState(DISABLE_DEACTIVATION);
        body->setUserIndex(from.id);
        bullet->addRigidBody(body);
        bodies[from.id] = body;
        made[from.id] = from;
        if (from.isSensor) act("sensor", from.id, 1, 0, 0);
        if (from.type == scenes::Type::kinematic) moved[from.id] = vector(from.vx, from.vy);
    }
    // What Bullet wants done anew, it gets by leaving the world and coming back.
    void act(const std::string& verb, int id, double x, double y, double z) override {
        if (verb == "gravity") return bullet->setGravity(vector(0, -x));
        btRigidBody& body = *bodies.at(id);
        body.activate(true);
        if (verb == "put") {
            btTransform at = body.getWorldTransform();
            at.setOrigin(vector(x, y));
            body.setWorldTransform(at), body.setInterpolationWorldTransform(at);
        } else if (verb == "fling" || verb == "moves") {
            if (body.isKinematicObject())
                moved[id] = vector(x, y);
            else
                body.setLinearVelocity(vector(x, y)), body.setAngularVelocity({0, 0, real(z)});
        } else if (verb == "lockTurn") {
            body.setAngularFactor({0, 0, 0});
        } else if (verb == "sensor") {
            const int flag = btCollisionObject::CF_NO_CONTACT_RESPONSE, flags = body.getCollisionFlags();
            body.setCollisionFlags(x != 0 ? flags | flag : flags & ~flag);
        } else if (verb == "sleep") {
            body.forceActivationState(ISLAND_SLEEPING);
        } else if (verb == "gravityScale") {
            body.setGravity(bullet->getGravity() * real(x));
        } else {
            bullet->removeRigidBody(&body);
            moved.erase(id);
            if (verb == "remove") return;
            if (verb == "mass") weigh(body, x, id);
            if (verb == "type") {
                body.setCollisionFlags(x == 1 ? btCollisionObject::CF_KINEMATIC_OBJECT : 0);
                weigh(body, x == 2 ? made[id].massKg : 0, id);
            }
            verb == "passes" && x != 0 ? bullet->addRigidBody(&body, 0, 0) : bullet->addRigidBody(&body);
        }
    }
    void weigh(btRigidBody& body, double kg, int id) {
        btVector3 inertia(0, 0, 0);
        if (kg > 0) body.getCollisionShape()->calculateLocalInertia(real(kg), inertia);
        if (made[id].isBox && kg > 0) inertia.setZ(real(made[id].inertia() * kg / made[id].massKg));
        body.setMassProps(real(kg), inertia);
        body.updateInertiaTensor();
    }
    void pin(int a, int b, double x, double y) override {
        const btVector3 at = vector(x, y), inA = bodies[a]->getWorldTransform().inverse() * at, axis(0, 0, 1);
        if (b > 0)
            joints.push_back(std::make_unique<btHingeConstraint>(
                *bodies[a], *bodies[b], inA, bodies[b]->getWorldTransform().inverse() * at, axis, axis));
        else
            joints.push_back(std::make_unique<btHingeConstraint>(*bodies[a], inA, axis));
        bullet->addConstraint(joints.back().get(), true);
    }
    void oneWay(int body) override {
        platform = bodies[body];
        dispatcher.setNearCallback(
            [](btBroadphasePair& pair, btCollisionDispatcher& to, const btDispatcherInfo& how) {
                const auto *a = static_cast<btCollisionObject*>(pair.m_pProxy0->m_clientObject),
                           *b = static_cast<btCollisionObject*>(pair.m_pProxy1->m_clientObject);
                const btRigidBody* other = btRigidBody::upcast(a == platform ? b : a);
                const bool isAsked = a == platform || b == platform;
                if (isAsked && scenes::passes(platform->getWorldTransform().getOrigin().y() + 0.05,
                                              other->getWorldTransform().getOrigin().y(),
                                              other->getLinearVelocity().y()))
                    return;
                btCollisionDispatcher::defaultNearCallback(pair, to, how);
            });
    }
    static btScalar real(double value) { return static_cast<btScalar>(value); }
    static btVector3 vector(double x, double y) { return {real(x), real(y), 0}; }
    void step() override {
        for (const auto& [id, velocity] : moved) { // of kinematic bodies: Bullet sees how far they went
            btTransform at = bodies.at(id)->getWorldTransform();
            at.setOrigin(at.getOrigin() + velocity * real(dt));
            bodies.at(id)->setWorldTransform(at);
        }
        bullet->stepSimulation(real(dt), 0);
    }
    scenes::Motion motion(int id) const override {
        const btRigidBody& body = *bodies.at(id);
        const btMatrix3x3& turned = body.getWorldTransform().getBasis();
        const btVector3 &at = body.getWorldTransform().getOrigin(), &v = body.getLinearVelocity();
        return {at.x(),
                at.y(),
                v.x(),
                v.y(),
                body.getAngularVelocity().z(),
                std::atan2(turned[1][0], turned[0][0])};
    }
    PhysVibBullet::Contacts contacts = PhysVibBullet::inSpace;
    double elasticity = 0, friction = 0;
    btDefaultCollisionConfiguration configuration;
    btCollisionDispatcher dispatcher{&configuration};
    btDbvtBroadphase broadphase;
    btSequentialImpulseConstraintSolver solver;
    std::unique_ptr<btDiscreteDynamicsWorld> bullet;
    std::unique_ptr<PhysVibBullet> haptics;
    std::map<int, btRigidBody*> bodies; // Bullet's, until the process ends
    std::map<int, scenes::Body> made;
    std::map<int, btVector3> moved;
    std::vector<std::unique_ptr<btCollisionShape>> shapes;
    std::vector<std::unique_ptr<btTypedConstraint>> joints;
    static inline btRigidBody* platform = nullptr; // Bullet's callback has no data
};

int main(int count, char** words) {
    Bullet engine;
    const int isPlane = scenes::isPlane(count, words) ? 1 : 0;
    if (isPlane != 0) engine.contacts = PhysVibBullet::inPlane;
    return scenes::run("Bullet", engine, count - isPlane, words + isPlane);
}
