// SPDX-License-Identifier: MIT
// How bodies start a step, and how far into it Box2D has advanced them when it reports a contact.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/IntegerMap.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Contacts of the regular pass are found where a step begins, those of the time-of-impact pass wherever the
/// body has been moved to. M only.
class BodySweeps {
public:
    /// Before b2World::Step: every body is where its step begins. Looks at each body once, as Box2D does
    /// several times, and at no fixture. Allocates if the world has grown.
    void beginStep(const b2World& world, double stepSeconds);

    double stepSeconds() const noexcept { return stepSeconds_; }
    /// of the one before; 0: there was none
    double lastStepSeconds() const noexcept { return lastStepSeconds_; }

    /// The largest mass of an enabled dynamic body, kg (m_max of Eq. 5.7).
    double largestMassKg() const noexcept { return largestMassKg_; }

    /// In BeginContact, PreSolve and EndContact: 0 (start) to 1 (end of the step), how far this body has
    /// come.
    double fraction(const b2Body& body) const noexcept;

    /// A number of the bodies that a world has and of their order (2^-64 of lists that differ have the same).
    static std::uint64_t censusOf(const b2World& world) noexcept;

    /// Velocity before the step; of a body that came later, its own.
    BodyMotion start(const b2Body& body) const noexcept;

private:
    struct Sweep {
        const b2Body* body; // not followed
        b2Vec2 centre;
        BodyMotion start;
    };
    const Sweep* find(const b2Body& body) const noexcept;
    void index();

    double stepSeconds_ = 0.0, lastStepSeconds_ = 0.0;
    double largestMassKg_ = 0.0;
    std::vector<Sweep> sweeps_; // of what is not static
    IntegerMap indices_;        // of the sweeps, by their bodies
};

} // namespace physvib
