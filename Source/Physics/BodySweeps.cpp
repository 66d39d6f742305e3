// SPDX-License-Identifier: MIT
// Inverts the straight line a body moves along within its step.
#include "Physics/BodySweeps.h"
#include <algorithm>

namespace physvib {

void BodySweeps::add(const b2Body& body) {
    const auto [place, isNew] = indices_.try_emplace(&body, sweeps_.size());
    if (isNew) sweeps_.push_back({&body, body.GetWorldCenter()});
}

void BodySweeps::beginStep(double stepSeconds) noexcept {
    stepSeconds_ = stepSeconds;
    for (Sweep& sweep : sweeps_) sweep.origin = sweep.body->GetWorldCenter();
}

void BodySweeps::solved(const b2Body& body) noexcept {
    const auto place = indices_.find(&body);
    if (place == indices_.end()) return;
    // Where the body would have started, had it moved with its present velocity all along.
    const b2Vec2 moved = static_cast<float>(stepSeconds_) * body.GetLinearVelocity();
    sweeps_[place->second].origin = body.GetWorldCenter() - moved;
}

double BodySweeps::fraction(const b2Body& a, const b2Body& b) const noexcept {
    const bool aIsFaster = a.GetLinearVelocity().LengthSquared() > b.GetLinearVelocity().LengthSquared();
    return fractionOf(aIsFaster ? a : b);
}

double BodySweeps::fractionOf(const b2Body& body) const noexcept {
    const auto place = indices_.find(&body);
    const b2Vec2 velocity = body.GetLinearVelocity();
    const double wholeStep = stepSeconds_ * velocity.LengthSquared();
    if (place == indices_.end() || wholeStep <= 0.0) return 0.0;
    const b2Vec2 moved = body.GetWorldCenter() - sweeps_[place->second].origin;
    return std::clamp(b2Dot(moved, velocity) / wholeStep, 0.0, 1.0);
}

} // namespace physvib
