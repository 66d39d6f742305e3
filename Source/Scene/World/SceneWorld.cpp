// SPDX-License-Identifier: MIT
// Builds a scene's Box2D world, and applies actions to it.
#include "Scene/World/SceneWorld.h"
#include "Core/PortableMath.h"
#include "Scene/World/SceneBodies.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <utility>

namespace physvib {

namespace {

// How long a removed body is kept: its impacts come up to ReleaseImpacts::latestNs later, some steps.
constexpr double heldSeconds = 0.5;

Vector turnedBy(const Vector& v, double angleRadians) {
    const double c = portable::cos(angleRadians), s = portable::sin(angleRadians);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
}

// Room in Box2D's pools, for a step that needs none then: contacts, springs of grips, and lists of what moved
// and of pairs, which grow by one proxy that is reported often. Two proxies that go in reverse order leave
// the tree as it was, so motion is the same to the bit.
void makeRoom(b2World& world, const Scene& scene) {
    auto& manager = const_cast<b2ContactManager&>(world.GetContactManager());
    const std::size_t contacts = std::min<std::size_t>(24 + scene.bodies.size(), 512);
    constexpr int pairs = 256; // that begin or end to be near in one step
    const auto makeBlocks = [&manager](std::size_t count, int bytes) {
        std::vector<void*> blocks(count);
        for (void*& block : blocks) block = manager.m_allocator->Allocate(bytes);
        for (void* const block : blocks) manager.m_allocator->Free(block, bytes);
    };
    makeBlocks(contacts, sizeof(b2Contact));
    if (std::ranges::any_of(scene.script, isAnyOf<GripAction>, &ScriptInput::action)) {
        makeBlocks(SceneGrips::expected, sizeof(b2MouseJoint));
        makeBlocks(1, sizeof(b2Body)); // the other end of the grips
    }
    struct {
        void AddPair(void*, void*) {}
    } nobody;
    const b2AABB place{{0.0F, 0.0F}, {0.0F, 0.0F}};
    const int first = manager.m_broadPhase.CreateProxy(place, nullptr),
              second = manager.m_broadPhase.CreateProxy(place, nullptr);
    for (int i = 0; i < pairs; ++i) manager.m_broadPhase.TouchProxy(second);
    manager.m_broadPhase.UpdatePairs(&nobody);
    manager.m_broadPhase.DestroyProxy(second);
    manager.m_broadPhase.DestroyProxy(first);
}

/// What turns with a motor.
template <class Set>
void forMotor(b2Joint& made, Set set) {
    if (made.GetType() == e_revoluteJoint) set(static_cast<b2RevoluteJoint&>(made));
    if (made.GetType() == e_wheelJoint) set(static_cast<b2WheelJoint&>(made));
}

} // namespace

SceneWorld::SceneWorld(const Scene& scene, std::uint32_t seed, const StepClock& clock)
    : scene_(scene)
    , clock_(clock)
    , jitters_(seed != 0)
    , random_(seed)
    , script_(scene_, clock)
    , gravity_(scene.gravityMetresPerSecond2)
    , world_(box2dVector(scene.gravityMetresPerSecond2))
    , materials_(scene.materials)
    , lastInputSeconds_(scene.inputs.empty() ? 0.0 : scene.inputs.back().timeSeconds) {
    if (!scene_.bodies.empty()) {
        scene_.inputs.reserve(scene_.inputs.size() + expectedInputs);
        paces_.reserve(expectedInputs);
        makeRoom(world_, scene_);
    }
    world_.SetContactFilter(&bound_);
    build();
    actOnScript(0);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) startHalfAStepBehind(*bodies_.at(i).body);
}

void SceneWorld::build() {
    const auto cast = scriptedCast(scene_);
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const bool isThere = i < scene_.bodies.size();
        const Body& body = add(cast[i], isThere ? startOf(cast[i]) : describedStart(cast[i]));
        if (!isThere) body.body->SetEnabled(false);
    }
    scripted_ = nextBody_;
    scriptedNames_ = bodyNames_;
    for (const JointDescription& joint : scene_.joints)
        joints_.emplace(joint.name, HeldJoint{&createJoint(world_, joint, *find(joint.bodyA)->body,
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
    std::vector<b2Fixture*> created;
    b2Body& made = createBody(world_, scene_, body, start, clock_.stepSeconds(), created);
    bodyNames_.emplace(body.name, nextBody_);
    Body& added =
        bodies_.emplace(nextBody_++, Body{&made, nextFixture_, std::move(created), body, body}).first->second;
    nextFixture_ += added.fixtures.size();
    if (body.type == BodyType::staticBody && body.velocityMetresPerSecond.x != 0.0) belts_.push_back(&added);
    return added;
}

BodyStart SceneWorld::startOf(const BodyDescription& body) {
    const bool moves = jitters_ && body.type == BodyType::dynamicBody;
    return moves ? jitteredStart(body, random_) : describedStart(body);
}

// Box2D adds a whole step of gravity before it moves a body, half a step too early. Velocities that start
// half a step behind turn this into the leapfrog scheme: bodies fall along the exact parabola.
void SceneWorld::startHalfAStepBehind(b2Body& body) const {
    if (body.GetType() != b2_dynamicBody) return;
    const b2Vec2 halfStep = static_cast<float>(-0.5 * clock_.stepSeconds()) * world_.GetGravity();
    body.SetLinearVelocity(body.GetLinearVelocity() + halfStep);
}

void SceneWorld::holdDevice() {
    const Vector turned = turnedBy(gravity_, hold_.angleRadians);
    const b2Vec2 gravity = box2dVector({hold_.factor * turned.x, hold_.factor * turned.y});
    if (gravity == world_.GetGravity()) return;
    world_.SetGravity(gravity);
    for (const auto& [number, body] : bodies_) body.body->SetAwake(true); // because sleeping bodies ignore it
}

SceneWorld::Body* SceneWorld::find(std::string_view name) noexcept {
    const auto place = bodyNames_.find(name);
    return place == bodyNames_.end() ? nullptr : &bodies_.at(place->second);
}

b2Body* SceneWorld::findInWorld(std::string_view name) noexcept {
    Body* const found = find(name);
    return found == nullptr ? nullptr : found->body;
}

void SceneWorld::setMaterial(Body& body, std::size_t fixture, int material) {
    body.now.fixtures[fixture].material = material;
    setSurface(*body.fixtures[fixture], body.now.fixtures[fixture],
               materials_[static_cast<std::size_t>(material)]);
    setMass(*body.body, body.now, scene_);
}

void SceneWorld::addInput(std::int64_t step, Action action) {
    lastInputSeconds_ = std::max(lastInputSeconds_, static_cast<double>(step) / clock_.stepsPerSecond);
    scene_.inputs.push_back({lastInputSeconds_, std::move(action)});
}

void SceneWorld::forgetDone() {
    if (2 * nextInput_ < scene_.inputs.size() || nextInput_ == 0) return; // each is moved once on average
    scene_.inputs.erase(scene_.inputs.begin(),
                        scene_.inputs.begin() + static_cast<std::ptrdiff_t>(nextInput_));
    nextInput_ = 0;
}

bool SceneWorld::act(std::int64_t step) {
    step_ = step;
    destroyRemoved(step);
    const bool live = actOnInputs(step), script = actOnScript(step);
    grips_.move(step + 1);
    for (const Body* belt : belts_) run(*belt);
    return live || script;
}

// Box2D's friction drives what touches it, on either side; a contact is there a step before it touches.
void SceneWorld::run(const Body& belt) {
    const auto speed = static_cast<float>(belt.described.velocityMetresPerSecond.x);
    for (b2ContactEdge* edge = belt.body->GetContactList(); edge != nullptr; edge = edge->next)
        edge->contact->SetTangentSpeed(speed);
}

// They have had neither contacts nor entries in Box2D's tree since they were disabled, so the order of the
// others is unchanged.
void SceneWorld::destroyRemoved(std::int64_t step) {
    for (; !leaving_.empty() && leaving_.front().step <= step; leaving_.pop_front()) {
        const auto gone = bodies_.find(leaving_.front().body);
        std::erase(belts_, &gone->second);
        world_.DestroyBody(gone->second.body);
        bodies_.erase(gone);
    }
}

bool SceneWorld::actOnInputs(std::int64_t step) {
    bool fixturesChanged = false;
    for (; nextInput_ < scene_.inputs.size(); ++nextInput_) {
        const LiveInput& input = scene_.inputs[nextInput_];
        if (clock_.firstStepAt(input.timeSeconds) > step) break;
        fixturesChanged |= apply(input.action);
    }
    return fixturesChanged;
}

bool SceneWorld::actOnScript(std::int64_t step) {
    bool fixturesChanged = false;
    const auto isDue = [&](const ScriptPace& pace) { return clock_.firstStepAt(pace.fromSeconds) <= step; };
    const auto later = std::ranges::find_if_not(paces_, isDue);
    std::for_each(paces_.begin(), later, [this](const ScriptPace& pace) { take(pace); });
    paces_.erase(paces_.begin(), later);
    const std::int64_t now = pace_.scriptStep(step, clock_);
    for (DueAction due = script_.next(now); due.action != nullptr; due = script_.next(now)) {
        const auto* spawn = std::get_if<SpawnAction>(due.action);
        if (spawn != nullptr) restart(*spawn, due.repetition);
        fixturesChanged |= spawn != nullptr || apply(*due.action);
    }
    return fixturesChanged;
}

void SceneWorld::take(const ScriptPace& pace) {
    const auto factor = static_cast<float>(pace.rate / std::exchange(pace_, pace).rate);
    const auto drive = [factor](auto& joint) { joint.SetMotorSpeed(joint.GetMotorSpeed() * factor); };
    for (auto& [name, joint] : joints_) forMotor(*joint.made, drive);
}

void SceneWorld::restart(const SpawnAction& action, int repetition) {
    const std::size_t number = spawned_.at(&action) + static_cast<std::size_t>(repetition);
    Body& body = bodies_.at(number);
    // the body was changed since
    if (std::size_t& named = bodyNames_.find(body.described.name)->second; named != number) {
        moveJoints(*bodies_.at(named).body, *body.body);
        retire(std::exchange(named, number));
    }
    for (std::size_t i = 0; i < body.fixtures.size(); ++i) {
        setMaterial(body, i, body.described.fixtures[i].material);
        body.now.fixtures[i].isCamera = body.described.fixtures[i].isCamera;
    }
    grips_.letGo(*body.body); // it starts anew
    restartBody(*body.body, body.described, startOf(body.described));
    startHalfAStepBehind(*body.body);
}

// It has no contacts any more. The script may spawn it again; a live body is destroyed once its impacts have
// been reported.
void SceneWorld::retire(std::size_t number) {
    b2Body& body = *bodies_.at(number).body;
    grips_.letGo(body);
    body.SetEnabled(false);
    if (number >= scripted_) leaving_.push_back({step_ + clock_.firstStepAt(heldSeconds), number});
}

void SceneWorld::moveJoints(b2Body& from, b2Body& to) {
    for (auto& [name, joint] : joints_)
        if (joint.made->GetBodyA() == &from || joint.made->GetBodyB() == &from)
            joint.made = &moveJoint(world_, *joint.made, from, to);
}

void SceneWorld::dropJoints(b2Body& body) {
    std::erase_if(joints_, [&](const auto& named) {
        b2Joint* const joint = named.second.made;
        if (joint->GetBodyA() != &body && joint->GetBodyB() != &body) return false;
        world_.DestroyJoint(joint);
        return true;
    });
}

/// What each action does when it comes.
struct SceneWorld::Acts {
    SceneWorld& w;

    void operator()(const GravityAction& action) const {
        w.gravity_ = action.metresPerSecond2;
        w.holdDevice();
    }
    void operator()(const TiltAction& action) const {
        w.gravity_ = turnedBy(w.scene_.gravityMetresPerSecond2, action.angleRadians);
        w.holdDevice();
    }
    void operator()(const HoldAction& action) const {
        w.hold_ = action;
        w.holdDevice();
    }
    void operator()(const ImpulseAction& action) const {
        b2Body* body = w.findInWorld(action.body);
        if (body == nullptr) return;
        const b2Vec2 point = action.pointMetres ? body->GetWorldPoint(box2dVector(*action.pointMetres))
                                                : body->GetWorldCenter();
        body->ApplyLinearImpulse(box2dVector(action.newtonSeconds), point, true);
    }
    void operator()(const VelocityAction& action) const {
        b2Body* body = w.findInWorld(action.body);
        if (body == nullptr) return;
        body->SetAwake(true); // also for a velocity of 0
        body->SetLinearVelocity(box2dVector(action.metresPerSecond));
        body->SetAngularVelocity(static_cast<float>(action.spinRadiansPerSecond));
    }
    void operator()(const GripAction& action) const {
        if (b2Body* body = w.findInWorld(action.body)) w.grips_.act(*body, action, w.step_);
    }

    /// Of a live input; a script's bodies are there already, see restart().
    void operator()(const SpawnAction& action) const {
        w.startHalfAStepBehind(*w.add(action.body, describedStart(action.body)).body);
    }
    void operator()(const RemoveAction& action) const {
        const auto place = w.bodyNames_.find(action.body);
        if (place == w.bodyNames_.end()) return;
        const std::size_t number = place->second;
        b2Body& body = *w.bodies_.at(number).body;
        if (number >= w.scripted_) {
            w.bodyNames_.erase(place);
            // the body was changed: the script may need the original
            const auto scripted = w.scriptedNames_.find(action.body);
            if (scripted == w.scriptedNames_.end())
                w.dropJoints(body);
            else {
                w.moveJoints(body, *w.bodies_.at(scripted->second).body);
                w.bodyNames_.emplace(*scripted);
            }
        }
        w.retire(number);
    }
    void operator()(const ChangeAction& action) const {
        const auto place = w.bodyNames_.find(action.body.name);
        Body* const before = place == w.bodyNames_.end() ? nullptr : &w.bodies_.at(place->second);
        const bool stays = action.stays && before != nullptr && before->body->IsEnabled();
        BodyStart start = describedStart(action.body);
        if (stays) {
            const b2Vec2 at = before->body->GetPosition(), speed = before->body->GetLinearVelocity();
            start = {{at.x, at.y}, before->body->GetAngle(), {speed.x, speed.y}};
        }
        const std::size_t old = before == nullptr ? w.nextBody_ : place->second;
        if (before != nullptr) w.bodyNames_.erase(place);
        b2Body& now = *w.add(action.body, start).body;
        if (stays)
            now.SetAngularVelocity(before->body->GetAngularVelocity());
        else
            w.startHalfAStepBehind(now);
        if (before == nullptr) return;
        w.moveJoints(*before->body, now);
        w.retire(old);
    }

    void operator()(const UnjoinAction& action) const {
        const auto joint = w.joints_.find(action.joint);
        if (joint == w.joints_.end()) return;
        w.world_.DestroyJoint(joint->second.made); // wakes both bodies
        w.joints_.erase(joint);
    }
    void operator()(const JoinAction& action) const {
        (*this)(UnjoinAction{action.joint.name});
        b2Body *const a = w.findInWorld(action.joint.bodyA), *const b = w.findInWorld(action.joint.bodyB);
        if (a != nullptr && b != nullptr)
            w.joints_.emplace(action.joint.name,
                              HeldJoint{&createJoint(w.world_, action.joint, *a, *b), action.joint.joint});
    }
    void operator()(const MotorAction& action) const {
        const auto place = w.joints_.find(action.joint);
        if (place == w.joints_.end()) return;
        forMotor(*place->second.made, [&](auto& joint) {
            joint.SetMotorSpeed(static_cast<float>(action.radiansPerSecond * w.pace_.rate));
            if (action.maxTorqueNewtonMetres)
                joint.SetMaxMotorTorque(static_cast<float>(*action.maxTorqueNewtonMetres));
        });
    }

    /// Calls `change` with a body and the indices of one of its fixtures, or of all.
    void forFixtures(const auto& action, auto change) const {
        Body* const meant = w.find(action.body);
        for (std::size_t i = 0; meant != nullptr && i < meant->fixtures.size(); ++i)
            if (action.fixture == everyFixture || static_cast<std::size_t>(action.fixture) == i)
                change(*meant, i);
    }
    void operator()(const CameraAction& action) const {
        forFixtures(action, [&](Body& body, std::size_t i) { body.now.fixtures[i].isCamera = action.isOn; });
    }
    void operator()(const MaterialAction& action) const {
        forFixtures(action, [&](Body& body, std::size_t i) { w.setMaterial(body, i, action.material); });
        if (b2Body* body = w.findInWorld(action.body))
            for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
                edge->contact->ResetFriction(); // contacts keep the values they began with
                edge->contact->ResetRestitution();
            }
    }
    void operator()(const SoundAction& action) const {
        Material& material = w.materials_[static_cast<std::size_t>(action.material)];
        material.frequencyHz = action.frequencyHz;
        material.decayPerSecond = action.decayPerSecond;
    }
    void operator()(const TextureAction& action) const {
        w.materials_[static_cast<std::size_t>(action.material)].setTexture(action.texture());
    }
};

bool SceneWorld::apply(const Action& action) {
    std::visit(Acts{*this}, action);
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

SceneWorld::FixtureNow SceneWorld::fixtureNow(const Body& body, std::size_t index) const noexcept {
    const FixtureDescription& description = body.now.fixtures[index];
    return {body.firstFixture + index, *body.fixtures[index], description,
            materials_[static_cast<std::size_t>(description.material)], body.now};
}

} // namespace physvib
