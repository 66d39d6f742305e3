// SPDX-License-Identifier: MIT
// Body states at the beginning of a step, and how far Box2D has advanced a body when it reports a contact.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/IntegerMap.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Contacts of the regular solver are found at the beginning of a step, those of the time-of-impact solver at
/// the time to which the body has been moved. World thread (M) only.
class BodySweeps {
public:
    /// Call before b2World::Step. Visits each body once (Box2D does so several times) and no fixture.
    /// Allocates if the world has grown.
    void beginStep(const b2World& world, double stepSeconds);

    double stepSeconds() const noexcept { return stepSeconds_; }
    /// of the last step; 0: there was none
    double lastStepSeconds() const noexcept { return lastStepSeconds_; }

    /// The largest mass of an enabled dynamic body, kg (m_max of Eq. 5.7).
    double largestMassKg() const noexcept { return largestMassKg_; }

    /// In BeginContact, PreSolve and EndContact: how far this body has been advanced, 0 (start) to 1 (end of
    /// the step).
    double fraction(const b2Body& body) const noexcept;

    /// Hash of a world's list of bodies and their order (different lists collide with a probability of
    /// 2^-64).
    static std::uint64_t censusOf(const b2World& world) noexcept;

    /// Velocity before the step; for a body that was created later, its present one.
    BodyMotion start(const b2Body& body) const noexcept;

private:
    struct Sweep {
        const b2Body* body; // used as an address only
        b2Vec2 centre;
        BodyMotion start;
    };
    const Sweep* find(const b2Body& body) const noexcept;
    void index();

    double stepSeconds_ = 0.0, lastStepSeconds_ = 0.0;
    double largestMassKg_ = 0.0;
    std::vector<Sweep> sweeps_; // of bodies that are not static
    IntegerMap indices_;        // indices into sweeps_, by body
};

} // namespace physvib
