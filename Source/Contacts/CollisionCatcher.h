// SPDX-License-Identifier: MIT
// The thesis' collision catcher (5.1.3): what a physics engine tells of its contacts during a step, in fixed arrays.
#pragma once
#include "Contacts/ChainLoads.h"
#include "Contacts/ContactGraph.h"
#include "Contacts/FixtureTable.h"
#include "Contacts/Impact.h"
#include "Contacts/IntegerMap.h"
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Keeps the contact graph up to date, and notes for each step which solid contacts began, with the solver's impulses
/// of that same step. An impulse of an older contact is no strike but a load, since a resting body pushes in every
/// step. Fixtures are slots of the table; contacts have names of the engine's choice, not 0. M only.
class CollisionCatcher {
public:
    /// Contacts that may begin in one step: those of cameras, and others, which may be handed on to cameras.
    /// A world that has more of them is a noise, not a touch.
    static constexpr std::size_t maxDirectRecords = 1024;
    static constexpr std::size_t maxDistantRecords = 4096;

    CollisionCatcher(const FixtureTable& table, ContactGraph& graph);

    /// Two fixtures that touched before anybody listened.
    void meet(std::int32_t a, std::int32_t b) { graph_.insert(a, b); }

    /// Right before the engine's step; the table is up to date.
    void beginStep();

    /// Right after it: what was noted is complete.
    void settle() noexcept;

    /// When all that was noted has been used.
    void endStep();

    /// The slot has another owner from now on: drops what was noted of it.
    void forget(std::int32_t slot) noexcept;

    bool isStepping() const noexcept { return isStepping_; }

    /// A contact of two solid fixtures begins. What is returned is to be filled in with where, when and how (its names
    /// and its place in the order are there, its impulses are 0); nullptr: outside a step, or without room (counted).
    ContactRecord* begin(std::uint64_t contact, std::int32_t a, std::int32_t b);

    /// It ends. What is returned is to be filled in likewise; nullptr: without room, and it is felt as if it had not
    /// ended in time.
    ContactEnd* end(std::int32_t a, std::int32_t b);

    /// The record of a contact that began in this step, to which the engine's impulses are added: one that opens and
    /// closes again within a step is still one hit. nullptr: it is older.
    ContactRecord* begun(std::uint64_t contact) noexcept;

    /// Whether a camera is one of the two.
    bool isFelt(std::int32_t a, std::int32_t b) const noexcept;

    /// What an older contact that is felt has pushed b by, and a by its opposite, N s in the world.
    void push(std::int32_t a, std::int32_t b, Vector2 newtonSeconds, Vector2 point) { loads_.add(a, b, newtonSeconds, point); }

    const std::vector<ContactRecord>& records() const noexcept { return records_; }
    /// Contacts that ended in the step or since the one before it.
    const std::vector<ContactEnd>& ends() const noexcept { return ends_; }
    const ChainLoads& loads() const noexcept { return loads_; }

    /// Contacts that found no room so far.
    std::uint64_t drops() const noexcept { return drops_; }

private:
    const FixtureTable& table_;
    ContactGraph& graph_;
    ChainLoads loads_;
    std::vector<ContactRecord> records_; // of the present step
    std::vector<ContactEnd> ends_;
    IntegerMap recordOf_{256}; // by the name of the contact; small, to stay in the nearest cache
    std::size_t directRecords_ = 0;
    std::int32_t order_ = 0;
    bool isStepping_ = false;
    std::uint64_t drops_ = 0;
};

} // namespace physvib
