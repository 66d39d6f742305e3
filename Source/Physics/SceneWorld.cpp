// SPDX-License-Identifier: MIT
// Building and changing a scene's world.
#include "Physics/SceneWorld.h"
#include "Physics/SceneBodies.h"
#include "Physics/SceneCast.h"
#include <algorithm>
#include <cmath>

namespace physvib {

SceneWorld::SceneWorld(const Scene& scene, std::uint32_t seed, const StepClock& clock)
    : scene_(scene)
    , clock_(clock)
    , jitters_(seed != 0)
    , random_(seed)
    , script_(scene_, clock)
    , world_(box2dVector(scene.gravityMetresPerSecond2))
    , cast_(sceneCast(scene))
    , now_(cast_) {
    build();
    act(0);
    for (std::size_t i = 0; i < scene_.bodies.size(); ++i) startHalfAStepBehind(*bodies_[i]);
}

void SceneWorld::build() {
    std::vector<b2Fixture*> fixtures;
    for (std::size_t i = 0; i < cast_.size(); ++i) {
        const bool isThere = i < scene_.bodies.size();
        const BodyStart start = isThere ? startOf(cast_[i]) : describedStart(cast_[i]);
        firstFixtures_.push_back(fixtures.size());
        bodies_.push_back(&createBody(world_, scene_, cast_[i], start, clock_.stepSeconds(), fixtures));
        if (!isThere) bodies_.back()->SetEnabled(false);
        for (std::size_t j = 0; j < cast_[i].fixtures.size(); ++j)
            fixtures_.push_back({fixtures[firstFixtures_[i] + j], i, j});
        bodyNames_.emplace(cast_[i].name, i);
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

void SceneWorld::setGravity(const b2Vec2& gravity) {
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
    setSurface(*part.fixture, scene_.materials[static_cast<std::size_t>(material)]);
    setMass(*bodies_[part.body], now_[part.body], scene_);
}

bool SceneWorld::act(std::int64_t step) {
    bool fixturesChanged = false;
    for (DueAction due = script_.next(step); due.action != nullptr; due = script_.next(step))
        fixturesChanged |= act(due);
    return fixturesChanged;
}

bool SceneWorld::act(const DueAction& due) {
    if (const auto* spawn = std::get_if<SpawnAction>(due.action)) return act(*spawn, due.repetition);
    return std::visit(
        [this](const auto& action) {
            if constexpr (requires { act(action); })
                return act(action);
            else
                return false;
        },
        *due.action);
}

bool SceneWorld::act(const GravityAction& action) {
    setGravity(box2dVector(action.metresPerSecond2));
    return false;
}

bool SceneWorld::act(const TiltAction& action) {
    const double c = std::cos(action.angleRadians), s = std::sin(action.angleRadians);
    const Vector& g = scene_.gravityMetresPerSecond2;
    setGravity(box2dVector({c * g.x - s * g.y, s * g.x + c * g.y}));
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

BodyPose SceneWorld::pose(std::size_t index) const noexcept {
    const b2Body& body = *bodies_[index];
    return {body.GetPosition().x, body.GetPosition().y, body.GetAngle(), body.IsEnabled()};
}

const FixtureDescription& SceneWorld::fixtureNow(std::size_t index) const noexcept {
    const Part& part = fixtures_[index];
    return now_[part.body].fixtures[part.index];
}

const BodyDescription& SceneWorld::bodyOf(std::size_t fixture) const noexcept {
    return now_[fixtures_[fixture].body];
}

} // namespace physvib
