// SPDX-License-Identifier: MIT
// Jolt through its adapter, in the scenes of the others. No Debian package has its headers: box2d3.sh
// compiles it.
#include <Jolt/Jolt.h>

#include <Jolt/Core/Factory.h>
#include <Jolt/Core/JobSystemSingleThreaded.h>
#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/BoxShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/Constraints/PointConstraint.h>
#include <Jolt/RegisterTypes.h>
#include <physvib/engines/physvib_jolt.h>

#include "Scenes.h"
#include <map>
#include <memory>

struct Jolt final : scenes::Engine, JPH::ContactListener {
    Jolt() {
        slowest = 60, handedOnPart = 0.05;
        verbs = "type put fling moves mass gravityScale gravity remove sensor passes sleep";
        pairs.EnableCollision(fixed, moving), pairs.EnableCollision(moving, moving);
        layers.MapObjectToBroadPhaseLayer(fixed, JPH::BroadPhaseLayer(0));
        for (const JPH::ObjectLayer each : {moving, passing})
            layers.MapObjectToBroadPhaseLayer(each, JPH::BroadPhaseLayer(1));
        broad = std::make_unique<JPH::ObjectVsBroadPhaseLayerFilterTable>(layers, 2, pairs, 3);
    }
    ~Jolt() override { end(); }
    void begin(double stepSeconds, double g, double e, double mu) override {
        end();
        dt = stepSeconds, elasticity = real(e), friction = real(mu);
        system = std::make_unique<JPH::PhysicsSystem>();
        system->Init(1024, 0, 4096, 4096, layers, *broad, pairs);
        system->SetGravity({0, real(-g), 0});
        haptics = std::make_unique<PhysVibJolt>(*system, world, this);
    }
    void end() { bodies.clear(), haptics.reset(), system.reset(), hasPlatform = false; }
    void add(const scenes::Body& from) override {
        JPH::Ref<JPH::Shape> shape =
            from.isBox
                ? static_cast<JPH::Shape*>(new JPH::BoxShape({real(from.width / 2), real(from.height / 2),
                                                              from.moves() ? real(from.width / 2) : 5.0F},
                                                             0))
                : new JPH::SphereShape(real(from.width / 2));
        const bool isFixed = from.kind() == scenes::Type::fixed;
        JPH::BodyCreationSettings made(shape, place(from.x, from.y), turned(from.angle),
                                       static_cast<JPH::EMotionType>(from.kind()),
                                       isFixed && from.massKg <= 0 ? fixed : moving);
        made.mRestitution = elasticity, made.mFriction = friction;
        made.mLinearDamping = made.mAngularDamping = 0;
        made.mAllowSleeping = false, made.mIsSensor = from.isSensor, made.mAllowDynamicOrKinematic = true;
        made.mMotionQuality = from.isBullet ? JPH::EMotionQuality::LinearCast : JPH::EMotionQuality::Discrete;
        made.mAllowedDOFs = JPH::EAllowedDOFs::TranslationX | JPH::EAllowedDOFs::TranslationY;
        if (from.turns) made.mAllowedDOFs |= JPH::EAllowedDOFs::RotationZ;
        made.mOverrideMassProperties = JPH::EOverrideMassProperties::CalculateInertia;
        made.mMassPropertiesOverride.mMass = real(from.massKg > 0 ? from.massKg : 1);
        const JPH::BodyID id = all().CreateAndAddBody(made, JPH::EActivation::Activate);
        bodies[from.id] = id;
        if (!isFixed) {
            all().SetLinearVelocity(id, {real(from.vx), real(from.vy), 0});
            all().SetAngularVelocity(id, {0, 0, real(from.spin)});
        }
        feel(from);
    }
    void feel(const scenes::Body& body) override {
        haptics->set(bodies.at(body.id), body.id, scenes::valuesOf(body.isSource));
    }
    void act(const std::string& verb, int number, double x, double y, double z) override {
        if (verb == "gravity") return system->SetGravity({0, real(-x), 0});
        const JPH::BodyID id = bodies.at(number);
        JPH::Body* const body = system->GetBodyLockInterfaceNoLock().TryGetBody(id);
        if (verb != "sleep" && verb != "remove" && !body->IsStatic()) all().ActivateBody(id);
        if (verb == "type")
            all().SetMotionType(id, static_cast<JPH::EMotionType>(x), JPH::EActivation::Activate);
        if (verb == "put") all().SetPosition(id, place(x, y), JPH::EActivation::Activate);
        if (verb == "fling" || verb == "moves") {
            if (body->IsStatic()) return;
            all().SetLinearVelocity(id, {real(x), real(y), 0});
            all().SetAngularVelocity(id, {0, 0, real(z)});
        }
        if (verb == "mass") {
            JPH::MotionProperties* const motion = body->GetMotionProperties();
            const float by = motion->GetInverseMass() * real(x);
            motion->SetInverseInertia(motion->GetInverseInertiaDiagonal() / by, motion->GetInertiaRotation());
            motion->SetInverseMass(1.0F / real(x));
        }
        if (verb == "gravityScale") all().SetGravityFactor(id, real(x));
        if (verb == "sensor") body->SetIsSensor(x != 0);
        if (verb == "passes") all().SetObjectLayer(id, x != 0 ? passing : moving);
        if (verb == "sleep") all().DeactivateBody(id);
        if (verb == "remove") haptics->remove(id), all().RemoveBody(id), all().DestroyBody(id);
    }
    std::string explain() override { return haptics->explain(); }
    void pin(int a, int b, double x, double y) override {
        JPH::PointConstraintSettings joint;
        joint.mPoint1 = joint.mPoint2 = place(x, y);
        JPH::Body* const first = system->GetBodyLockInterfaceNoLock().TryGetBody(bodies[a]);
        JPH::Body* const second =
            b > 0 ? system->GetBodyLockInterfaceNoLock().TryGetBody(bodies[b]) : &JPH::Body::sFixedToWorld;
        system->AddConstraint(joint.Create(*first, *second));
    }
    void oneWay(int body) override { platform = bodies[body], hasPlatform = true; }
    void OnContactAdded(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                        JPH::ContactSettings& settings) override {
        if (!hasPlatform || (a.GetID() != platform && b.GetID() != platform)) return;
        const JPH::Body &top = a.GetID() == platform ? a : b, &other = &top == &a ? b : a;
        settings.mIsSensor = scenes::passes(static_cast<double>(top.GetPosition().GetY()) + 0.05,
                                            static_cast<double>(other.GetPosition().GetY()),
                                            static_cast<double>(other.GetLinearVelocity().GetY()));
        static_cast<void>(manifold);
    }
    void OnContactPersisted(const JPH::Body& a, const JPH::Body& b, const JPH::ContactManifold& manifold,
                            JPH::ContactSettings& settings) override {
        OnContactAdded(a, b, manifold, settings);
    }
    void step() override {
        haptics->update(real(dt), &memory, &jobs);
        if (!haptics->error().empty()) std::fprintf(stderr, "%s\n", haptics->error().c_str());
    }
    scenes::Motion motion(int id) const override {
        const JPH::Body* const body = system->GetBodyLockInterfaceNoLock().TryGetBody(bodies.at(id));
        const JPH::RVec3 at = body->GetCenterOfMassPosition();
        const JPH::Vec3 v = body->GetLinearVelocity();
        const JPH::Quat q = body->GetRotation();
        return {static_cast<double>(at.GetX()),    static_cast<double>(at.GetY()),      v.GetX(), v.GetY(),
                body->GetAngularVelocity().GetZ(), 2.0 * std::atan2(q.GetZ(), q.GetW())};
    }
    JPH::BodyInterface& all() const { return system->GetBodyInterfaceNoLock(); }
    static float real(double value) { return static_cast<float>(value); }
    static JPH::RVec3 place(double x, double y) { return JPH::RVec3(real(x), real(y), 0); }
    static JPH::Quat turned(double angle) {
        return {0, 0, real(std::sin(angle / 2)), real(std::cos(angle / 2))};
    }
    static constexpr JPH::ObjectLayer fixed = 0, moving = 1, passing = 2;
    float elasticity = 0, friction = 0;
    JPH::ObjectLayerPairFilterTable pairs{3};
    JPH::BroadPhaseLayerInterfaceTable layers{3, 2};
    std::unique_ptr<JPH::ObjectVsBroadPhaseLayerFilterTable> broad;
    JPH::TempAllocatorMalloc memory;
    JPH::JobSystemSingleThreaded jobs{JPH::cMaxPhysicsJobs};
    std::unique_ptr<JPH::PhysicsSystem> system;
    std::unique_ptr<PhysVibJolt> haptics;
    std::map<int, JPH::BodyID> bodies;
    JPH::BodyID platform;
    bool hasPlatform = false;
};

int main(int count, char** words) {
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory;
    JPH::RegisterTypes();
    Jolt engine;
    return scenes::run("Jolt", engine, count, words);
}
