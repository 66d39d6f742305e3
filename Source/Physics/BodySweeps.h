// SPDX-License-Identifier: MIT
// How far into its step Box2D has advanced a body when it reports a contact; it does not say so itself.
#pragma once
#include <box2d/box2d.h>
#include <cstddef>
#include <unordered_map>
#include <vector>

namespace physvib {

/// Within a step a body moves along a straight line: position = origin + fraction * step * velocity. Contacts
/// of the regular pass are found at fraction 0, those of the time-of-impact pass wherever the body has been
/// moved to. M only.
class BodySweeps {
public:
    /// Follows `body` from the next beginStep() on; a body known already is left as it is. Allocates.
    void add(const b2Body& body);

    /// Before b2World::Step: every body is where its step begins.
    void beginStep(double stepSeconds) noexcept;

    /// In PostSolve: the solver has put `body` at the end of its step and perhaps given it another velocity.
    void solved(const b2Body& body) noexcept;

    /// In BeginContact: 0 (start) to 1 (end of the step), after the faster body of the two. 0 for unknown
    /// bodies.
    double fraction(const b2Body& a, const b2Body& b) const noexcept;

private:
    double fractionOf(const b2Body& body) const noexcept;

    struct Sweep {
        const b2Body* body;
        b2Vec2 origin;
    };
    double stepSeconds_ = 0.0;
    std::vector<Sweep> sweeps_;
    std::unordered_map<const b2Body*, std::size_t> indices_; // looked up, never walked through
};

} // namespace physvib
