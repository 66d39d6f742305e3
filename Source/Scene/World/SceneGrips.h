// SPDX-License-Identifier: MIT
// Hands that hold bodies: each is a spring from a point of a body to where the hand is, as strong as a hand
// may be.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/StepClock.h"
#include <box2d/box2d.h>
#include <cstdint>
#include <vector>

namespace physvib {

/// The grips of one world, one per body. A hand goes straight and evenly, so that what it drags over a rough
/// surface is not felt to follow it in jumps. Whoever disables or destroys a body lets it go before. M only.
class SceneGrips {
public:
    static constexpr float springHz = 5.0F; ///< Box2D's own for a mouse: firm, and calm at 100 steps a second
    static constexpr float dampingRatio = 0.7F;

    /// Both outlive the grips.
    SceneGrips(b2World& world, const StepClock& clock) noexcept
        : world_(world)
        , clock_(clock) {}

    /// From `step` on. Allocates when a grip begins.
    void act(b2Body& body, const GripAction& action, std::int64_t step);
    void letGo(b2Body& body);

    /// Hands are where they are when `step` begins.
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
    b2Body* ground_ = nullptr; // what hands stand on, for Box2D
};

} // namespace physvib
