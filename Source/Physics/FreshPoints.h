// SPDX-License-Identifier: MIT
// Detects which points of Box2D's contacts are new: where surfaces that were apart have met.
#pragma once
#include "Contacts/IntegerMap.h"
#include <array>
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// A point is new from when Box2D finds it until the end of the step in which the solver has applied an
/// impulse there. That may be a later step, for a disabled contact (a one-way platform) or a contact found in
/// a step of length 0. A point whose id Box2D's manifold keeps is old. Contacts are identified by their
/// addresses. World thread (M) only.
class FreshPoints {
public:
    FreshPoints() { entries_.reserve(expectedContacts); }

    /// In PreSolve: updates a contact and returns its new points, one bit each. Outside a reported step,
    /// whose end is not known, a point with an impulse is old at once.
    unsigned look(const b2Contact& contact, const b2Manifold& before, bool isStepping);

    /// In PostSolve: the same; marks the points as having an impulse.
    unsigned solved(const b2Contact& contact) noexcept;

    /// In EndContact.
    void forget(const b2Contact& contact) noexcept;

    /// Call right after the step: points with an impulse become old.
    void endStep() noexcept;

private:
    static constexpr std::size_t expectedContacts = 1024; // contacts that begin in a step, or are disabled

    struct Entry {
        std::uint64_t contact;
        std::array<std::uint32_t, 2 * b2_maxManifoldPoints> ids; // of all solver passes of a step
        int count;
        bool isSolved;
    };
    int find(const b2Contact& contact) const noexcept;
    static bool has(const Entry& entry, std::uint32_t id) noexcept;
    static unsigned maskOf(const Entry& entry, const b2Manifold& manifold) noexcept;
    void drop(std::size_t entry) noexcept;

    std::vector<Entry> entries_;
    IntegerMap indices_; // small, to stay in the first-level cache
};

} // namespace physvib
