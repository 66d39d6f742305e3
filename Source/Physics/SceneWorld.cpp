// SPDX-License-Identifier: MIT
// Building and changing a scene's world.
#include "Physics/SceneWorld.h"
#include "Physics/SceneBodies.h"
#include "Physics/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

namespace physvib {

namespace {

Vector turnedBy(const Vector& v, double angleRadians) {
    const double c = std::cos(angleRadians), s = std::sin(angleRadians);
    return {c * v.x - s * v.y, s * v.x + c * v.y};
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
    , materials_(scene.materials) {
    world_.SetContactFilter(&bound_);
    build();
    actOnScript(0);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) startHalfAStepBehind(*bodies_[i]);
}

void SceneWorld::build() {
    const auto cast = scriptedCast(scene_);
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const bool isThere = i < scene_.bodies.size();
        b2Body& body = add(cast[i], isThere ? startOf(cast[i]) : describedStart(cast[i]));
        if (!isThere) body.SetEnabled(false);
    }
    for (const JointDescription& joint : scene_.joints)
        joints_.emplace(joint.name, &createJoint(world_, joint, *bodies_[bodyNames_.at(joint.bodyA)],
                                                 *bodies_[bodyNames_.at(joint.bodyB)]));
    std::size_t next = scene_.bodies.size();
    for (const ScriptInput& input : scene_.script)
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action)) {
            spawned_.emplace(spawn, next);
            next += static_cast<std::size_t>(input.times);
        }
}

b2Body& SceneWorld::add(const BodyDescription& body, const BodyStart& start) {
    std::vector<b2Fixture*> created;
    b2Body& made = createBody(world_, scene_, body, start, clock_.stepSeconds(), created);
    firstFixtures_.push_back(fixtures_.size());
    for (std::size_t j = 0; j < created.size(); ++j) fixtures_.push_back({created[j], bodies_.size(), j});
    bodyNames_.emplace(body.name, bodies_.size());
    bodies_.push_back(&made);
    cast_.push_back(body);
    now_.push_back(body);
    return made;
}

BodyStart SceneWorld::startOf(const BodyDescription& body) {
    const bool moves = jitters_ && body.type == BodyType::dynamicBody;
    return moves ? jitteredStart(body, random_) : describedStart(body);
}

// Box2D adds a whole step of gravity before it moves a body, which is half a step too early. Velocities that
// start half a step behind make this the leapfrog scheme: bodies fall along the exact parabola.
void SceneWorld::startHalfAStepBehind(b2Body& body) const {
    if (body.GetType() != b2_dynamicBody) return;
    const b2Vec2 halfStep = static_cast<float>(-0.5 * clock_.stepSeconds()) * world_.GetGravity();
    body.SetLinearVelocity(body.GetLinearVelocity() + halfStep);
}

void SceneWorld::setGravity(const Vector& beforeHold) {
    gravity_ = beforeHold;
    holdDevice();
}

void SceneWorld::holdDevice() {
    const Vector turned = turnedBy(gravity_, hold_.angleRadians);
    const b2Vec2 gravity = box2dVector({hold_.factor * turned.x, hold_.factor * turned.y});
    if (gravity == world_.GetGravity()) return;
    world_.SetGravity(gravity);
    for (b2Body* body : bodies_) body->SetAwake(true); // sleeping bodies would not notice
}

b2Body* SceneWorld::find(std::string_view name) const noexcept {
    const auto place = bodyNames_.find(name);
    return place == bodyNames_.end() ? nullptr : bodies_[place->second];
}

template <class Change>
void SceneWorld::forFixtures(const std::string& body, int fixture, Change change) {
    const auto place = bodyNames_.find(body);
    if (place == bodyNames_.end()) return;
    const std::size_t first = firstFixtures_[place->second];
    for (std::size_t i = 0; i < cast_[place->second].fixtures.size(); ++i)
        if (fixture == everyFixture || static_cast<std::size_t>(fixture) == i) change(first + i);
}

void SceneWorld::setMaterial(std::size_t fixture, int material) {
    const Part& part = fixtures_[fixture];
    now_[part.body].fixtures[part.index].material = material;
    setSurface(*part.fixture, materials_[static_cast<std::size_t>(material)]);
    setMass(*bodies_[part.body], now_[part.body], scene_);
}

void SceneWorld::addInput(std::int64_t step, Action action) {
    const double last = scene_.inputs.empty() ? 0.0 : scene_.inputs.back().timeSeconds;
    const double seconds = std::max(last, static_cast<double>(step) / clock_.stepsPerSecond);
    scene_.inputs.push_back({seconds, std::move(action)});
}

bool SceneWorld::act(std::int64_t step) {
    const bool live = actOnInputs(step);
    return actOnScript(step) || live;
}

bool SceneWorld::actOnInputs(std::int64_t step) {
    bool fixturesChanged = false;
    for (; nextInput_ < scene_.inputs.size(); ++nextInput_) {
        const LiveInput& input = scene_.inputs[nextInput_];
        if (clock_.firstStepAt(input.timeSeconds) > step) break;
        const auto* wanted = std::get_if<SpawnAction>(&input.action);
        fixturesChanged |= wanted != nullptr ? spawn(wanted->body) : apply(input.action);
    }
    return fixturesChanged;
}

bool SceneWorld::actOnScript(std::int64_t step) {
    bool fixturesChanged = false;
    for (DueAction due = script_.next(step); due.action != nullptr; due = script_.next(step))
        fixturesChanged |= act(due);
    return fixturesChanged;
}

bool SceneWorld::act(const DueAction& due) {
    if (const auto* spawn = std::get_if<SpawnAction>(due.action)) return act(*spawn, due.repetition);
    return apply(*due.action);
}

bool SceneWorld::apply(const Action& action) {
    return std::visit(
        [this](const auto& one) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(one)>, SpawnAction>)
                return act(one);
            else
                return false; // it needs to know who spawns
        },
        action);
}

bool SceneWorld::spawn(const BodyDescription& body) {
    startHalfAStepBehind(add(body, describedStart(body)));
    return true;
}

bool SceneWorld::act(const GravityAction& action) {
    setGravity(action.metresPerSecond2);
    return false;
}

bool SceneWorld::act(const TiltAction& action) {
    setGravity(turnedBy(scene_.gravityMetresPerSecond2, action.angleRadians));
    return false;
}

bool SceneWorld::act(const HoldAction& action) {
    hold_ = action;
    holdDevice();
    return false;
}

bool SceneWorld::act(const ImpulseAction& action) const {
    b2Body* body = find(action.body);
    if (body == nullptr) return false;
    const b2Vec2 point =
        action.pointMetres ? body->GetWorldPoint(box2dVector(*action.pointMetres)) : body->GetWorldCenter();
    body->ApplyLinearImpulse(box2dVector(action.newtonSeconds), point, true);
    return false;
}

bool SceneWorld::act(const VelocityAction& action) const {
    b2Body* body = find(action.body);
    if (body == nullptr) return false;
    body->SetAwake(true); // also for a velocity of 0
    body->SetLinearVelocity(box2dVector(action.metresPerSecond));
    body->SetAngularVelocity(static_cast<float>(action.spinRadiansPerSecond));
    return false;
}

bool SceneWorld::act(const SpawnAction& action, int repetition) {
    const std::size_t body = spawned_.at(&action) + static_cast<std::size_t>(repetition);
    for (std::size_t i = 0; i < cast_[body].fixtures.size(); ++i) {
        setMaterial(firstFixtures_[body] + i, cast_[body].fixtures[i].material);
        now_[body].fixtures[i].isCamera = cast_[body].fixtures[i].isCamera;
    }
    restartBody(*bodies_[body], cast_[body], startOf(cast_[body]));
    startHalfAStepBehind(*bodies_[body]);
    return true;
}

bool SceneWorld::act(const RemoveAction& action) const {
    b2Body* body = find(action.body);
    if (body == nullptr) return false;
    body->SetEnabled(false);
    return false;
}

bool SceneWorld::act(const MotorAction& action) const {
    const auto place = joints_.find(action.joint);
    if (place == joints_.end()) return false;
    const auto set = [&action](auto& joint) {
        joint.SetMotorSpeed(static_cast<float>(action.radiansPerSecond));
        if (action.maxTorqueNewtonMetres)
            joint.SetMaxMotorTorque(static_cast<float>(*action.maxTorqueNewtonMetres));
    };
    if (place->second->GetType() == e_revoluteJoint) set(static_cast<b2RevoluteJoint&>(*place->second));
    if (place->second->GetType() == e_wheelJoint) set(static_cast<b2WheelJoint&>(*place->second));
    return false;
}

bool SceneWorld::act(const CameraAction& action) {
    forFixtures(action.body, action.fixture, [&](std::size_t fixture) {
        const Part& part = fixtures_[fixture];
        now_[part.body].fixtures[part.index].isCamera = action.isOn;
    });
    return true;
}

bool SceneWorld::act(const MaterialAction& action) {
    forFixtures(action.body, action.fixture,
                [&](std::size_t fixture) { setMaterial(fixture, action.material); });
    if (b2Body* body = find(action.body))
        for (b2ContactEdge* edge = body->GetContactList(); edge != nullptr; edge = edge->next) {
            edge->contact->ResetFriction(); // contacts keep the values they began with
            edge->contact->ResetRestitution();
        }
    return true;
}

bool SceneWorld::act(const SoundAction& action) {
    Material& material = materials_[static_cast<std::size_t>(action.material)];
    material.frequencyHz = action.frequencyHz;
    material.decayPerSecond = action.decayPerSecond;
    return true;
}

BodyPose SceneWorld::pose(std::size_t index) const noexcept {
    const b2Body& body = *bodies_[index];
    return {body.GetPosition().x, body.GetPosition().y, body.GetAngle(), body.IsEnabled()};
}

const FixtureDescription& SceneWorld::fixtureNow(std::size_t index) const noexcept {
    const Part& part = fixtures_[index];
    return now_[part.body].fixtures[part.index];
}

const Material& SceneWorld::materialOf(std::size_t fixture) const noexcept {
    return materials_[static_cast<std::size_t>(fixtureNow(fixture).material)];
}

const BodyDescription& SceneWorld::bodyOf(std::size_t fixture) const noexcept {
    return now_[fixtures_[fixture].body];
}

} // namespace physvib
