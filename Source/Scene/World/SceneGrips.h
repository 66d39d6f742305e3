// SPDX-License-Identifier: MIT
// Grips of hands on bodies: each is a spring of limited force from a point of a body to the hand.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/StepClock.h"
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
    void act(b2Body& body, const GripAction& action, std::int64_t step);
    void letGo(b2Body& body);

    /// Moves all hands to their places at the beginning of `step`.
    void move(std::int64_t step);

private:
    struct Grip {
        b2Body* body;
        b2MouseJoint* joint;
        b2Vec2 from, to;
        std::int64_t start, end; // steps
        b2Vec2 at(std::int64_t step) const noexcept;
    };
    Grip& hold(b2Body& body, const std::optional<Vector>& point);
    b2Body& ground();

    b2World& world_;
    const StepClock& clock_;
    std::vector<Grip> grips_;  // in the order in which they began
    b2Body* ground_ = nullptr; // the other body of all mouse joints
};

} // namespace physvib
