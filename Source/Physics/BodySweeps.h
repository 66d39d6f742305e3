// SPDX-License-Identifier: MIT
// How bodies start a step, and how far into it Box2D has advanced them when it reports a contact: it does not
// say so itself.
#pragma once
#include "Contacts/BodyReader.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Within a step a body moves along a straight line: position = origin + fraction * step * velocity. Contacts
/// of the regular pass are found at fraction 0, those of the time-of-impact pass wherever the body has been
/// moved to. Bodies are named by their place in the world's list. M only.
class BodySweeps {
public:
    /// Before b2World::Step: every body is where its step begins. Allocates if the world has grown.
    void beginStep(const b2World& world, double stepSeconds);

    /// In PostSolve: the solver has put `body` at the end of its step and perhaps given it another velocity.
    void solved(std::int32_t index, const b2Body& body) noexcept;

    /// In BeginContact and EndContact: 0 (start) to 1 (end of the step), how far this body has come.
    double fraction(std::int32_t index, const b2Body& body) const noexcept;

    double stepSeconds() const noexcept { return stepSeconds_; }

    /// Velocity before the step.
    const BodyMotion& start(std::int32_t index) const noexcept { return at(index).start; }

private:
    struct Sweep {
        b2Vec2 origin;
        BodyMotion start;
    };
    const Sweep& at(std::int32_t index) const noexcept { return sweeps_[static_cast<std::size_t>(index)]; }

    double stepSeconds_ = 0.0;
    std::vector<Sweep> sweeps_;
};

} // namespace physvib
