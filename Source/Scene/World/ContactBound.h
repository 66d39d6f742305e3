// SPDX-License-Identifier: MIT
// No more contacts than a step can bear.
#pragma once
#include "Scene/SceneLimits.h"
#include <box2d/box2d.h>
#include <cstdint>

namespace physvib {

/// Bodies in one place touch in pairs, which are as many as the square of the bodies: two thousand would ask
/// for a gigabyte and minutes. From maxContacts on, pairs pass through each other, and are counted. M only.
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
