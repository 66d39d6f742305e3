// SPDX-License-Identifier: MIT
// Body states at the beginning of a step, and how far Box2D has advanced a body when it reports a contact.
#pragma once
#include "Contacts/IntegerMap.h"
#include "Physics/BoxPrivates.h"
#include "Physics/WorldNames.h"
#include <algorithm>
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace physvib {

/// Contacts of the regular solver are found at the beginning of a step, those of the time-of-impact solver at
/// the time to which the body has been moved. World thread (M) only.
class BodySweeps {
public:
    /// Call before b2World::Step. Visits each body once (Box2D does so several times) and no fixture.
    /// Allocates if the world has grown.
    void beginStep(const b2World& world, double stepSeconds) {
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

    double stepSeconds() const noexcept { return stepSeconds_; }
    /// of the last step; 0: there was none
    double lastStepSeconds() const noexcept { return lastStepSeconds_; }

    /// The largest mass of an enabled dynamic body, kg (m_max of Eq. 5.7).
    double largestMassKg() const noexcept { return largestMassKg_; }

    /// In BeginContact, PreSolve and EndContact: how far this body has been advanced, 0 (start) to 1 (end of
    /// the step).
    double fraction(const b2Body& body) const noexcept {
        const Sweep* sweep = find(body);
        // otherwise Box2D's value is from an earlier step
        const bool hasMoved = sweep != nullptr && body.GetWorldCenter() != sweep->centre;
        return hasMoved ? static_cast<double>(advancedPartOf(body)) : 0.0;
    }

    /// Hash of a world's list of bodies and their order (different lists collide with a probability of
    /// 2^-64).
    static std::uint64_t censusOf(const b2World& world) noexcept {
        std::uint64_t sum = static_cast<std::uint64_t>(world.GetBodyCount()) + 1; // never 0
        for (const b2Body* body = world.GetBodyList(); body != nullptr; body = body->GetNext())
            sum = (sum ^ idOf(*body)) * 0x9E3779B97F4A7C15U;
        return sum;
    }

    /// Velocity before the step; for a body that was created later, its present one.
    BodyMotion start(const b2Body& body) const noexcept {
        const Sweep* sweep = find(body);
        return sweep == nullptr ? motionOf(body) : sweep->start;
    }

private:
    struct Sweep {
        const b2Body* body; // used as an address only
        b2Vec2 centre;
        BodyMotion start;
    };
    const Sweep* find(const b2Body& body) const noexcept {
        const std::int32_t i = indices_.find(idOf(body));
        return i == IntegerMap::none ? nullptr : &sweeps_[static_cast<std::size_t>(i)];
    }
    void index() {
        indices_.clear();
        for (std::size_t i = 0; i < sweeps_.size(); ++i)
            indices_.set(idOf(*sweeps_[i].body), static_cast<std::int32_t>(i));
    }

    double stepSeconds_ = 0.0, lastStepSeconds_ = 0.0;
    double largestMassKg_ = 0.0;
    std::vector<Sweep> sweeps_; // of bodies that are not static
    IntegerMap indices_;        // indices into sweeps_, by body
};

} // namespace physvib
