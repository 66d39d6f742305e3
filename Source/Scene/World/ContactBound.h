// SPDX-License-Identifier: MIT
// Limits the number of simultaneous contacts in a world, to bound time and memory per step.
#pragma once
#include "Scene/SceneLimits.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

/// Bodies in one place touch pairwise, and pairs grow with the square of the bodies: two thousand would need
/// a gigabyte and minutes. Beyond maxContacts, pairs pass through each other and are counted. Message thread
/// (M) only.
class ContactBound final : public b2ContactFilter {
public:
    explicit ContactBound(const b2World& world)
        : world_{world} {}

    bool ShouldCollide(b2Fixture* a, b2Fixture* b) override {
        if (!b2ContactFilter::ShouldCollide(a, b)) return false;
        if (world_.GetContactCount() < sceneLimits::maxContacts) return true;
        ++refused_;
        return false;
    }

    std::uint64_t refused() const noexcept { return refused_; }

private:
    const b2World& world_;
    std::uint64_t refused_ = 0;
};

} // namespace physvib
