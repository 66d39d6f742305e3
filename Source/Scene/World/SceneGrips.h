// SPDX-License-Identifier: MIT
// Grips of hands on bodies: each is a spring of limited force from a point of a body to the hand.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneLimits.h"
#include "Scene/World/SceneBodies.h"
#include "Scene/World/StepClock.h"
#include <algorithm>
#include <box2d/box2d.h>
#include <cstdint>
#include <vector>

namespace physvib {

/// The grips of one world, one per body. A hand moves straight at constant speed, so that a dragged body does
/// not move in jumps. Release a body before it is disabled or destroyed. Message thread (M) only.
class SceneGrips {
public:
    static constexpr float springHz = 5.0F; ///< Box2D's own value for mouse joints: firm, and stable at 100
                                            ///< steps a second
    static constexpr float dampingRatio = 0.7F;

    /// Both outlive the grips.
    SceneGrips(b2World& world, const StepClock& clock) noexcept
        : world_(world)
        , clock_(clock) {}

    /// From `step` on. Allocates when a grip begins.
    void act(b2Body& body, const GripAction& action, std::int64_t step) {
        if (!action.toMetres) return letGo(body);
        if (body.GetType() != b2_dynamicBody || !body.IsEnabled()) return;
        Grip& grip = hold(body, action.pointMetres);
        grip.from = grip.joint->GetTarget();
        grip.to = box2dVector(*action.toMetres);
        grip.start = step;
        grip.end = step + clock_.firstStepAt(action.overSeconds);
    }
    void letGo(b2Body& body) {
        const auto grip = std::ranges::find(grips_, &body, &Grip::body);
        if (grip == grips_.end()) return;
        world_.DestroyJoint(grip->joint);
        grips_.erase(grip);
    }

    /// Moves all hands to their places at the beginning of `step`.
    void move(std::int64_t step) {
        for (Grip& grip : grips_) grip.joint->SetTarget(grip.at(step));
    }

private:
    struct Grip {
        b2Body* body;
        b2MouseJoint* joint;
        b2Vec2 from, to;
        std::int64_t start, end; // steps
        b2Vec2 at(std::int64_t step) const noexcept {
            if (step >= end) return to;
            const auto share =
                static_cast<float>(static_cast<double>(step - start) / static_cast<double>(end - start));
            return from + share * (to - from);
        }
    };
    Grip& hold(b2Body& body, const std::optional<Vector>& point) {
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
    // Without fixtures, so it has no contacts. Created by the first grip, so that worlds without grips are
    // unchanged.
    b2Body& ground() {
        if (ground_ == nullptr) {
            const b2BodyDef def;
            ground_ = world_.CreateBody(&def);
        }
        return *ground_;
    }

    b2World& world_;
    const StepClock& clock_;
    std::vector<Grip> grips_;  // in the order in which they began
    b2Body* ground_ = nullptr; // the other body of all mouse joints
};

} // namespace physvib
