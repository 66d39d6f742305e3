// SPDX-License-Identifier: MIT
// Which points of Box2D's contacts are new: where surfaces that were apart have met and nothing has been
// pushed yet.
#pragma once
#include "Contacts/IntegerMap.h"
#include <array>
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// A point is fresh from when Box2D finds it until the end of the step in which the solver has pushed there:
/// in a contact that is switched off (a one-way platform), or was found in a step without time, that is
/// later. A point that Box2D's manifold keeps, by its id, is old. Contacts are known by their addresses. M
/// only.
class FreshPoints {
public:
    FreshPoints() { entries_.reserve(expectedContacts); }

    /// In PreSolve: brings a contact up to date; which of its points are fresh, a bit for each. Outside a
    /// step that is told, nobody knows where one ends: what has been pushed is old at once.
    unsigned look(const b2Contact& contact, const b2Manifold& before, bool isStepping);

    /// In PostSolve: the same, and its points have been pushed.
    unsigned solved(const b2Contact& contact) noexcept;

    /// In EndContact.
    void forget(const b2Contact& contact) noexcept;

    /// Right after the step: what has been pushed is old from now on.
    void endStep() noexcept;

private:
    static constexpr std::size_t expectedContacts = 1024; // that begin in a step, or are switched off

    struct Entry {
        std::uint64_t contact;
        std::array<std::uint32_t, 2 * b2_maxManifoldPoints> ids; // of all passes of a step
        int count;
        bool isSolved;
    };
    int find(const b2Contact& contact) const noexcept;
    static bool has(const Entry& entry, std::uint32_t id) noexcept;
    static unsigned maskOf(const Entry& entry, const b2Manifold& manifold) noexcept;
    void drop(std::size_t entry) noexcept;

    std::vector<Entry> entries_;
    IntegerMap indices_; // no larger than need be, to stay in the nearest cache
};

} // namespace physvib
