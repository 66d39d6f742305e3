// SPDX-License-Identifier: MIT
// Records each body's position and velocity at the beginning of a step.
#include "Physics/BodySweeps.h"
#include "Physics/BoxPrivates.h"
#include "Physics/WorldNames.h"
#include <algorithm>
#include <utility>

namespace physvib {

void BodySweeps::beginStep(const b2World& world, double stepSeconds) {
    lastStepSeconds_ = std::exchange(stepSeconds_, stepSeconds);
    largestMassKg_ = 0.0;
    std::size_t count = 0;
    bool isKnown = true; // usually the bodies and their order are those of the last step
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext()) {
        if (body->GetType() == b2_staticBody) continue;
        isKnown = isKnown && count < sweeps_.size() && sweeps_[count].body == body;
        const Sweep sweep{body, body->GetWorldCenter(), motionOf(*body)};
        if (count < sweeps_.size())
            sweeps_[count] = sweep;
        else
            sweeps_.push_back(sweep);
        ++count;
        if (body->GetType() == b2_dynamicBody && body->IsEnabled())
            largestMassKg_ = std::max(largestMassKg_, static_cast<double>(body->GetMass()));
    }
    if (isKnown && count == sweeps_.size()) return;
    sweeps_.erase(sweeps_.begin() + static_cast<std::ptrdiff_t>(count), sweeps_.end());
    index();
}

std::uint64_t BodySweeps::censusOf(const b2World& world) noexcept {
    std::uint64_t sum = static_cast<std::uint64_t>(world.GetBodyCount()) + 1; // never 0
    for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
        sum = (sum ^ nameOf(*body)) * 0x9E3779B97F4A7C15U;
    return sum;
}

void BodySweeps::index() {
    indices_.clear();
    for (std::size_t i = 0; i < sweeps_.size(); ++i)
        indices_.set(nameOf(*sweeps_[i].body), static_cast<std::int32_t>(i));
}

const BodySweeps::Sweep* BodySweeps::find(const b2Body& body) const noexcept {
    const std::int32_t i = indices_.find(nameOf(body));
    return i == IntegerMap::none ? nullptr : &sweeps_[static_cast<std::size_t>(i)];
}

double BodySweeps::fraction(const b2Body& body) const noexcept {
    const Sweep* sweep = find(body);
    // otherwise Box2D's value is from an earlier step
    const bool hasMoved = sweep != nullptr && body.GetWorldCenter() != sweep->centre;
    return hasMoved ? static_cast<double>(advancedPartOf(body)) : 0.0;
}

BodyMotion BodySweeps::start(const b2Body& body) const noexcept {
    const Sweep* sweep = find(body);
    return sweep == nullptr ? motionOf(body) : sweep->start;
}

} // namespace physvib
