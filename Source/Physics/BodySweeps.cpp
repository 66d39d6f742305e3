// SPDX-License-Identifier: MIT
// Inverts the straight line a body moves along within its step.
#include "Physics/BodySweeps.h"
#include "Physics/WorldNames.h"
#include <algorithm>

namespace physvib {

void BodySweeps::beginStep(const b2World& world, double stepSeconds) {
    stepSeconds_ = stepSeconds;
    sweeps_.clear();
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        sweeps_.push_back({body->GetWorldCenter(), motionOf(*body)});
}

void BodySweeps::solved(std::int32_t index, const b2Body& body) noexcept {
    // Where the body would have started, had it moved with its present velocity all along.
    const b2Vec2 moved = static_cast<float>(stepSeconds_) * body.GetLinearVelocity();
    sweeps_[static_cast<std::size_t>(index)].origin = body.GetWorldCenter() - moved;
}

double BodySweeps::fraction(std::int32_t index, const b2Body& body) const noexcept {
    const b2Vec2 velocity = body.GetLinearVelocity();
    const double wholeStep = stepSeconds_ * velocity.LengthSquared();
    if (wholeStep <= 0.0) return 0.0;
    return std::clamp(b2Dot(body.GetWorldCenter() - at(index).origin, velocity) / wholeStep, 0.0, 1.0);
}

} // namespace physvib
