// SPDX-License-Identifier: MIT
// Implements grips by Box2D mouse joints, whose targets move between inputs.
#include "Scene/World/SceneGrips.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/SceneBodies.h"
#include <algorithm>

namespace physvib {

b2Vec2 SceneGrips::Grip::at(std::int64_t step) const noexcept {
    if (step >= end) return to;
    const auto share =
        static_cast<float>(static_cast<double>(step - start) / static_cast<double>(end - start));
    return from + share * (to - from);
}

void SceneGrips::act(b2Body& body, const GripAction& action, std::int64_t step) {
    if (!action.toMetres) return letGo(body);
    if (body.GetType() != b2_dynamicBody || !body.IsEnabled()) return;
    Grip& grip = hold(body, action.pointMetres);
    grip.from = grip.joint->GetTarget();
    grip.to = box2dVector(*action.toMetres);
    grip.start = step;
    grip.end = step + clock_.firstStepAt(action.overSeconds);
}

SceneGrips::Grip& SceneGrips::hold(b2Body& body, const std::optional<Vector>& point) {
    auto grip = std::ranges::find(grips_, &body, &Grip::body);
    if (grip == grips_.end()) {
        b2MouseJointDef def;
        def.bodyA = &ground();
        def.bodyB = &body;
        def.target = point ? body.GetWorldPoint(box2dVector(*point)) : body.GetWorldCenter();
        grip = grips_.insert(grips_.end(),
                             {&body, static_cast<b2MouseJoint*>(world_.CreateJoint(&def)), {}, {}, 0, 0});
    }
    float stiffness = 0.0F, damping = 0.0F; // recomputed each time, because the mass may have changed
    b2LinearStiffness(stiffness, damping, springHz, dampingRatio, &ground(), &body);
    grip->joint->SetStiffness(stiffness);
    grip->joint->SetDamping(damping);
    grip->joint->SetMaxForce(static_cast<float>(sceneLimits::maxGripMetresPerSecond2) * body.GetMass());
    return *grip;
}

void SceneGrips::letGo(b2Body& body) {
    const auto grip = std::ranges::find(grips_, &body, &Grip::body);
    if (grip == grips_.end()) return;
    world_.DestroyJoint(grip->joint);
    grips_.erase(grip);
}

void SceneGrips::move(std::int64_t step) {
    for (Grip& grip : grips_) grip.joint->SetTarget(grip.at(step));
}

// Without fixtures, so it has no contacts. Created by the first grip, so that worlds without grips are
// unchanged.
b2Body& SceneGrips::ground() {
    if (ground_ == nullptr) {
        const b2BodyDef def;
        ground_ = world_.CreateBody(&def);
    }
    return *ground_;
}

} // namespace physvib
