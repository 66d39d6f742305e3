// SPDX-License-Identifier: MIT
// Builds a scene's Box2D world, and executes scripted and live actions in it.
#include "Scene/World/SceneWorld.h"
#include "Scene/World/BodyLists.h"
#include "Scene/World/BodyMass.h"
#include "Scene/World/SceneBodies.h"
#include <algorithm>
#include <utility>

namespace physvib {

using detail::rotated;

namespace {

// Time until a removed body is destroyed: longer than impacts are delayed (ReleaseImpacts::latestNs).
constexpr double removalDelaySeconds = 0.5;

// Fills Box2D's pools, so that steps do not allocate: blocks for contacts and grips, and the broad phase's
// buffers of moved proxies and pairs, which grow when one proxy is reported as moved many times. Destroying
// the two proxies in reverse order restores the tree, so motion is the same to the bit.
void reservePools(b2World& world, const Scene& scene) {
    auto& manager = const_cast<b2ContactManager&>(world.GetContactManager());
    const std::size_t contacts = std::min<std::size_t>(24 + scene.bodies.size(), 512);
    constexpr int pairs = 256; // maximum of pairs that come near each other in one step
    const auto makeBlocks = [&manager](std::size_t count, int bytes) {
        std::vector<void*> blocks(count);
        for (void*& block : blocks) block = manager.m_allocator->Allocate(bytes);
        for (void* const block : blocks) manager.m_allocator->Free(block, bytes);
    };
    makeBlocks(contacts, sizeof(b2Contact));
    if (std::ranges::any_of(scene.script, isAnyOf<GripAction>, &ScriptInput::action)) {
        makeBlocks(SceneGrips::reservedGrips, sizeof(b2MouseJoint));
        makeBlocks(1, sizeof(b2Body)); // the static body of the grips
    }
    struct {
        void AddPair(void*, void*) {}
    } pairCallback;
    const b2AABB bounds{{0.0F, 0.0F}, {0.0F, 0.0F}};
    const int first = manager.m_broadPhase.CreateProxy(bounds, nullptr),
              second = manager.m_broadPhase.CreateProxy(bounds, nullptr);
    for (int i = 0; i < pairs; ++i) manager.m_broadPhase.TouchProxy(second);
    manager.m_broadPhase.UpdatePairs(&pairCallback);
    manager.m_broadPhase.DestroyProxy(second);
    manager.m_broadPhase.DestroyProxy(first);
}

/// Calls `set` with the joint as its own type if it is a hinge or a wheel.
template <class Set>
void withMotor(b2Joint& joint, Set set) {
    if (joint.GetType() == e_revoluteJoint) set(static_cast<b2RevoluteJoint&>(joint));
    if (joint.GetType() == e_wheelJoint) set(static_cast<b2WheelJoint&>(joint));
}

void scaleMotorSpeed(b2Joint& joint, double factor) {
    const auto scale = [factor](auto& motor) {
        motor.SetMotorSpeed(motor.GetMotorSpeed() * static_cast<float>(factor));
    };
    withMotor(joint, scale);
    if (joint.GetType() == e_prismaticJoint) scale(static_cast<b2PrismaticJoint&>(joint));
}

} // namespace

SceneWorld::SceneWorld(const Scene& scene, std::uint32_t seed, const StepClock& clock)
    : scene_(scene)
    , clock_(clock)
    , hasJitter_(seed != 0)
    , random_(seed)
    , script_(scene_, clock)
    , gravity_(scene.gravityMetresPerSecond2)
    , world_(box2dVector(scene.gravityMetresPerSecond2))
    , materials_(scene.materials)
    , lastInputSeconds_(scene.inputs.empty() ? 0.0 : scene.inputs.back().timeSeconds) {
    if (!scene_.bodies.empty()) {
        scene_.inputs.reserve(scene_.inputs.size() + reservedInputs);
        pendingPaces_.reserve(reservedInputs);
        reservePools(world_, scene_);
    }
    world_.SetContactFilter(&contactLimit_);
    build();
    executeScript(0);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) delayHalfAStep(*bodies_.at(i).body);
}

void SceneWorld::build() {
    const auto scripted = scriptedBodies(scene_);
    for (std::size_t i = 0; i < scripted.size(); ++i) {
        const bool isPresent = i < scene_.bodies.size();
        const Body& body = add(scripted[i], isPresent ? makeStart(scripted[i]) : describedStart(scripted[i]));
        if (!isPresent) body.body->SetEnabled(false);
    }
    scriptedBodyCount_ = nextBody_;
    scriptedNames_ = bodyNames_;
    for (const JointDescription& joint : scene_.joints)
        joints_.emplace(joint.name, WorldJoint{&createJoint(world_, joint, *find(joint.bodyA)->body,
                                                            *find(joint.bodyB)->body),
                                               joint.joint});
    std::size_t next = scene_.bodies.size();
    for (const ScriptInput& input : scene_.script)
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action)) {
            spawned_.emplace(spawn, next);
            next += static_cast<std::size_t>(input.times);
        }
}

SceneWorld::Body& SceneWorld::add(const BodyDescription& body, const BodyStart& start) {
    std::vector<b2Fixture*> fixtures;
    b2Body& worldBody = createBody(world_, scene_, body, start, clock_.stepSeconds(), fixtures);
    bodyNames_.emplace(body.name, nextBody_);
    Body& newBody =
        bodies_.emplace(nextBody_++, Body{&worldBody, nextFixture_, std::move(fixtures), body, body})
            .first->second;
    nextFixture_ += newBody.fixtures.size();
    if (body.type == BodyType::staticBody && body.velocityMetresPerSecond.x != 0.0)
        belts_.push_back(&newBody);
    return newBody;
}

BodyStart SceneWorld::makeStart(const BodyDescription& body) {
    const bool isJittered = hasJitter_ && body.type == BodyType::dynamicBody;
    return isJittered ? jitteredStart(body, random_) : describedStart(body);
}

// Box2D adds a whole step of gravity before it moves a body, half a step too early. Velocities that start
// half a step behind turn this into the leapfrog scheme: bodies fall along the exact parabola.
void SceneWorld::delayHalfAStep(b2Body& body) const {
    if (body.GetType() != b2_dynamicBody) return;
    const b2Vec2 halfStep = static_cast<float>(-0.5 * clock_.stepSeconds()) * world_.GetGravity();
    body.SetLinearVelocity(body.GetLinearVelocity() + halfStep);
}

void SceneWorld::applyGravity() {
    const Vector turned = rotated(gravity_, hold_.angleRadians);
    const b2Vec2 gravity = box2dVector({hold_.factor * turned.x, hold_.factor * turned.y});
    if (gravity == world_.GetGravity()) return;
    world_.SetGravity(gravity);
    for (const auto& [number, body] : bodies_) body.body->SetAwake(true); // because sleeping bodies ignore it
}

SceneWorld::Body* SceneWorld::find(std::string_view name) noexcept {
    const auto entry = bodyNames_.find(name);
    return entry == bodyNames_.end() ? nullptr : &bodies_.at(entry->second);
}

b2Body* SceneWorld::findInWorld(std::string_view name) noexcept {
    Body* const found = find(name);
    return found == nullptr ? nullptr : found->body;
}

void SceneWorld::setMaterial(Body& body, std::size_t fixture, int material) {
    body.current.fixtures[fixture].material = material;
    setSurface(*body.fixtures[fixture], body.current.fixtures[fixture],
               materials_[static_cast<std::size_t>(material)]);
    setMass(*body.body, body.current, scene_);
}

void SceneWorld::addInput(std::int64_t step, Action action) {
    lastInputSeconds_ = std::max(lastInputSeconds_, static_cast<double>(step) / clock_.stepsPerSecond);
    scene_.inputs.push_back({lastInputSeconds_, std::move(action)});
}

void SceneWorld::dropExecutedInputs() {
    if (2 * nextInput_ < scene_.inputs.size() || nextInput_ == 0)
        return; // so that each input is moved once on average
    scene_.inputs.erase(scene_.inputs.begin(),
                        scene_.inputs.begin() + static_cast<std::ptrdiff_t>(nextInput_));
    nextInput_ = 0;
}

bool SceneWorld::executeActions(std::int64_t step) {
    step_ = step;
    destroyRemoved(step);
    const bool inputsChanged = executeInputs(step), scriptChanged = executeScript(step);
    grips_.moveHands(step + 1);
    for (const Body* belt : belts_) driveBelt(*belt);
    return inputsChanged || scriptChanged;
}

// Box2D's friction moves bodies that touch the belt on either side. Contacts exist a step before they touch,
// so all of them get the speed in time.
void SceneWorld::driveBelt(const Body& belt) {
    const auto speed = static_cast<float>(belt.original.velocityMetresPerSecond.x);
    for (b2ContactEdge* edge = belt.body->GetContactList(); edge != nullptr; edge = edge->next)
        edge->contact->SetTangentSpeed(speed);
}

// Removed bodies have had neither contacts nor entries in Box2D's tree since they were disabled, so the order
// of the others is unchanged.
void SceneWorld::destroyRemoved(std::int64_t step) {
    for (; !pendingRemovals_.empty() && pendingRemovals_.front().step <= step; pendingRemovals_.pop_front()) {
        const auto removed = bodies_.find(pendingRemovals_.front().body);
        std::erase(belts_, &removed->second);
        world_.DestroyBody(removed->second.body);
        bodies_.erase(removed);
    }
}

bool SceneWorld::executeInputs(std::int64_t step) {
    bool fixturesChanged = false;
    for (; nextInput_ < scene_.inputs.size(); ++nextInput_) {
        const LiveInput& input = scene_.inputs[nextInput_];
        if (clock_.firstStepAt(input.timeSeconds) > step) break;
        fixturesChanged |= apply(input.action);
    }
    return fixturesChanged;
}

bool SceneWorld::executeScript(std::int64_t step) {
    bool fixturesChanged = false;
    const auto isDue = [&](const ScriptPace& pace) { return clock_.firstStepAt(pace.fromSeconds) <= step; };
    const auto later = std::ranges::find_if_not(pendingPaces_, isDue);
    std::for_each(pendingPaces_.begin(), later, [this](const ScriptPace& pace) { applyPace(pace); });
    pendingPaces_.erase(pendingPaces_.begin(), later);
    const std::int64_t scriptStep = pace_.scriptStep(step, clock_);
    for (DueAction due = script_.next(scriptStep); due.action != nullptr; due = script_.next(scriptStep)) {
        const auto* spawn = std::get_if<SpawnAction>(due.action);
        if (spawn != nullptr) restart(*spawn, due.repetition);
        fixturesChanged |= spawn != nullptr || apply(*due.action);
    }
    return fixturesChanged;
}

void SceneWorld::applyPace(const ScriptPace& pace) {
    const double factor = pace.rate / std::exchange(pace_, pace).rate;
    for (auto& [name, joint] : joints_) scaleMotorSpeed(*joint.joint, factor);
}

void SceneWorld::restart(const SpawnAction& action, int repetition) {
    const std::size_t number = spawned_.at(&action) + static_cast<std::size_t>(repetition);
    Body& body = bodies_.at(number);
    // a ChangeAction has replaced the body: its joints return to this one
    if (std::size_t& named = bodyNames_.find(body.original.name)->second; named != number) {
        moveJoints(*bodies_.at(named).body, *body.body);
        removeFromWorld(std::exchange(named, number));
    }
    for (std::size_t i = 0; i < body.fixtures.size(); ++i) {
        setMaterial(body, i, body.original.fixtures[i].material);
        body.current.fixtures[i].isCamera = body.original.fixtures[i].isCamera;
    }
    grips_.release(*body.body); // because the body restarts
    restartBody(*body.body, body.original, makeStart(body.original));
    delayHalfAStep(*body.body);
}

// Disables the body, which ends its contacts. The script may enable one of its bodies again; a live body is
// destroyed once its impacts have been reported.
void SceneWorld::removeFromWorld(std::size_t number) {
    b2Body& body = *bodies_.at(number).body;
    grips_.release(body);
    body.SetEnabled(false);
    if (number >= scriptedBodyCount_)
        pendingRemovals_.push_back({step_ + clock_.firstStepAt(removalDelaySeconds), number});
}

void SceneWorld::moveJoints(b2Body& from, b2Body& to) {
    for (auto& [name, joint] : joints_)
        if (joint.joint->GetBodyA() == &from || joint.joint->GetBodyB() == &from)
            joint.joint = &moveJoint(world_, *joint.joint, from, to);
}

void SceneWorld::destroyJoints(b2Body& body) {
    std::erase_if(joints_, [&](const auto& named) {
        b2Joint* const joint = named.second.joint;
        if (joint->GetBodyA() != &body && joint->GetBodyB() != &body) return false;
        world_.DestroyJoint(joint);
        return true;
    });
}

/// Visitor that executes an action of any kind.
struct SceneWorld::ActionExecutor {
    SceneWorld& world;

    void operator()(const GravityAction& action) const {
        world.gravity_ = action.gravityMetresPerSecond2;
        world.applyGravity();
    }
    void operator()(const TiltAction& action) const {
        world.gravity_ = rotated(world.scene_.gravityMetresPerSecond2, action.angleRadians);
        world.applyGravity();
    }
    void operator()(const HoldAction& action) const {
        world.hold_ = action;
        world.applyGravity();
    }
    void operator()(const ImpulseAction& action) const {
        b2Body* body = world.findInWorld(action.body);
        if (body == nullptr) return;
        const b2Vec2 point = action.pointMetres ? body->GetWorldPoint(box2dVector(*action.pointMetres))
                                                : body->GetWorldCenter();
        body->ApplyLinearImpulse(box2dVector(action.impulseNewtonSeconds), point, true);
    }
    void operator()(const VelocityAction& action) const {
        b2Body* body = world.findInWorld(action.body);
        if (body == nullptr) return;
        body->SetAwake(true); // also for a velocity of 0
        body->SetLinearVelocity(box2dVector(action.velocityMetresPerSecond));
        body->SetAngularVelocity(static_cast<float>(action.spinRadiansPerSecond));
    }
    void operator()(const GripAction& action) const {
        if (b2Body* body = world.findInWorld(action.body)) world.grips_.apply(*body, action, world.step_);
    }

    /// For live inputs only; a script's bodies exist already and restart(), see there.
    void operator()(const SpawnAction& action) const {
        world.delayHalfAStep(*world.add(action.body, describedStart(action.body)).body);
    }
    void operator()(const RemoveAction& action) const {
        const auto entry = world.bodyNames_.find(action.body);
        if (entry == world.bodyNames_.end()) return;
        const std::size_t number = entry->second;
        b2Body& body = *world.bodies_.at(number).body;
        if (number >= world.scriptedBodyCount_) {
            world.bodyNames_.erase(entry);
            // the body replaced one of the script, which may spawn the original again
            const auto scripted = world.scriptedNames_.find(action.body);
            if (scripted == world.scriptedNames_.end())
                world.destroyJoints(body);
            else {
                world.moveJoints(body, *world.bodies_.at(scripted->second).body);
                world.bodyNames_.emplace(*scripted);
            }
        }
        world.removeFromWorld(number);
    }
    void operator()(const ChangeAction& action) const {
        const auto entry = world.bodyNames_.find(action.body.name);
        Body* const oldBody = entry == world.bodyNames_.end() ? nullptr : &world.bodies_.at(entry->second);
        const bool stays = action.stays && oldBody != nullptr && oldBody->body->IsEnabled();
        BodyStart start = describedStart(action.body);
        if (stays) {
            const b2Vec2 position = oldBody->body->GetPosition(), speed = oldBody->body->GetLinearVelocity();
            start = {{position.x, position.y}, oldBody->body->GetAngle(), {speed.x, speed.y}};
        }
        const std::size_t oldNumber = oldBody == nullptr ? world.nextBody_ : entry->second;
        if (oldBody != nullptr) world.bodyNames_.erase(entry);
        b2Body& newBody = *world.add(action.body, start).body;
        if (stays)
            newBody.SetAngularVelocity(oldBody->body->GetAngularVelocity());
        else
            world.delayHalfAStep(newBody);
        if (oldBody == nullptr) return;
        world.moveJoints(*oldBody->body, newBody);
        world.removeFromWorld(oldNumber);
    }

    void operator()(const UnjoinAction& action) const {
        const auto joint = world.joints_.find(action.joint);
        if (joint == world.joints_.end()) return;
        world.world_.DestroyJoint(joint->second.joint); // wakes both bodies
        world.joints_.erase(joint);
    }
    void operator()(const JoinAction& action) const {
        (*this)(UnjoinAction{action.joint.name});
        b2Body *const a = world.findInWorld(action.joint.bodyA), *const b =
                                                                     world.findInWorld(action.joint.bodyB);
        if (a == nullptr || b == nullptr) return;
        b2Joint& joined = createJoint(world.world_, action.joint, *a, *b);
        scaleMotorSpeed(joined, world.pace_.rate);
        world.joints_.emplace(action.joint.name, WorldJoint{&joined, action.joint.joint});
    }
    void operator()(const MotorAction& action) const {
        const auto entry = world.joints_.find(action.joint);
        if (entry == world.joints_.end()) return;
        withMotor(*entry->second.joint, [&](auto& joint) {
            joint.SetMotorSpeed(static_cast<float>(action.speedRadiansPerSecond * world.pace_.rate));
            if (action.maxTorqueNewtonMetres)
                joint.SetMaxMotorTorque(static_cast<float>(*action.maxTorqueNewtonMetres));
        });
    }

    /// Calls change(body, index) for the action's fixture, or for every fixture of its body.
    void forFixtures(const auto& action, auto change) const {
        Body* const target = world.find(action.body);
        for (std::size_t i = 0; target != nullptr && i < target->fixtures.size(); ++i)
            if (action.fixture == everyFixture || static_cast<std::size_t>(action.fixture) == i)
                change(*target, i);
    }
    void operator()(const CameraAction& action) const {
        forFixtures(action,
                    [&](Body& body, std::size_t i) { body.current.fixtures[i].isCamera = action.isOn; });
    }
    void operator()(const MaterialAction& action) const {
        forFixtures(action, [&](Body& body, std::size_t i) { world.setMaterial(body, i, action.material); });
        if (b2Body* body = world.findInWorld(action.body))
            for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
                edge->contact->ResetFriction(); // contacts keep the values they began with
                edge->contact->ResetRestitution();
            }
    }
    void operator()(const SoundAction& action) const {
        Material& material = world.materials_[static_cast<std::size_t>(action.material)];
        material.frequencyHz = action.frequencyHz;
        material.decayPerSecond = action.decayPerSecond;
    }
    void operator()(const TextureAction& action) const {
        world.materials_[static_cast<std::size_t>(action.material)].setTexture(action.texture());
    }
};

bool SceneWorld::apply(const Action& action) {
    std::visit(ActionExecutor{*this}, action);
    return isAnyOf<SpawnAction, ChangeAction, CameraAction, MaterialAction, SoundAction, TextureAction>(
        action);
}

BodyPose SceneWorld::pose(std::size_t number) const noexcept {
    const auto found = bodies_.find(number);
    return found == bodies_.end() ? BodyPose{0.0, 0.0, 0.0, false} : poseOf(*found->second.body);
}

BodyPose SceneWorld::poseOf(const b2Body& body) noexcept {
    return {body.GetPosition().x, body.GetPosition().y, body.GetAngle(), body.IsEnabled()};
}

SceneWorld::CurrentFixture SceneWorld::currentFixture(const Body& body, std::size_t index) const noexcept {
    const FixtureDescription& description = body.current.fixtures[index];
    return {body.firstFixture + index, *body.fixtures[index], description,
            materials_[static_cast<std::size_t>(description.material)], body.current};
}

} // namespace physvib
