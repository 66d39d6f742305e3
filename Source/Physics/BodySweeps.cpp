// SPDX-License-Identifier: MIT
// Inverts the straight line a body moves along within its step.
#include "Physics/BodySweeps.h"
#include "Physics/WorldNames.h"
#include <algorithm>
#include <utility>

namespace physvib {

void BodySweeps::beginStep(const b2World& world, double stepSeconds) {
    lastStepSeconds_ = std::exchange(stepSeconds_, stepSeconds);
    largestMassKg_ = 0.0;
    std::size_t count = 0;
    bool isKnown = true; // the same bodies in the same order as in the last step, which is the rule
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
        if (body->GetType() == b2_staticBody) continue;
        isKnown = isKnown && count < sweeps_.size() && sweeps_[count].body == body;
        const Sweep sweep{body, body->GetWorldCenter(), motionOf(*body)};
        if (count < sweeps_.size()) sweeps_[count] = sweep;
        else sweeps_.push_back(sweep);
        ++count;
        if (body->GetType() == b2_dynamicBody && body->IsEnabled()) largestMassKg_ = std::max(largestMassKg_, static_cast<double>(body->GetMass()));
    }
    if (isKnown && count == sweeps_.size()) return;
    sweeps_.erase(sweeps_.begin() + static_cast<std::ptrdiff_t>(count), sweeps_.end());
    index();
}

void BodySweeps::index() {
    indices_.clear();
    for (std::size_t i = 0; i < sweeps_.size(); ++i) indices_.set(nameOf(*sweeps_[i].body), static_cast<std::int32_t>(i));
}

const BodySweeps::Sweep* BodySweeps::find(const b2Body& body) const noexcept {
    const std::int32_t i = indices_.find(nameOf(body));
    return i == IntegerMap::none ? nullptr : &sweeps_[static_cast<std::size_t>(i)];
}

void BodySweeps::solved(const b2Body& body, std::int32_t& hint) noexcept {
    const auto at = static_cast<std::size_t>(hint);
    if (hint < 0 || at >= sweeps_.size() || sweeps_[at].body != &body) hint = indices_.find(nameOf(body));
    if (hint == IntegerMap::none) return;
    // Where the body would have started, had it moved with its present velocity all along.
    const b2Vec2 moved = static_cast<float>(stepSeconds_) * body.GetLinearVelocity();
    sweeps_[static_cast<std::size_t>(hint)].origin = body.GetWorldCenter() - moved;
}

double BodySweeps::fraction(const b2Body& body) const noexcept {
    const Sweep* sweep = find(body);
    const b2Vec2 velocity = body.GetLinearVelocity();
    const double wholeStep = stepSeconds_ * velocity.LengthSquared();
    if (sweep == nullptr || wholeStep <= 0.0) return 0.0;
    return std::clamp(b2Dot(body.GetWorldCenter() - sweep->origin, velocity) / wholeStep, 0.0, 1.0);
}

BodyMotion BodySweeps::start(const b2Body& body) const noexcept {
    const Sweep* sweep = find(body);
    return sweep == nullptr ? motionOf(body) : sweep->start;
}

} // namespace physvib
