// SPDX-License-Identifier: MIT
// The fixtures of a world and what PhysVib knows of them, beside the world, whose user data stay the user's.
#pragma once
#include "Physics/HapticFixture.h"
#include "Physics/IntegerMap.h"
#include <box2d/box2d.h>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace physvib {

/// One fixture of the world.
struct KnownFixture {
    const b2Fixture* fixture = nullptr; ///< nullptr: the slot is free
    const b2Body* body = nullptr;       ///< valid during a step
    std::int32_t bodyIndex = 0;         ///< place of the body in the world's list, valid during a step
    std::int32_t id = 0;                ///< in events; below -1: the user has given it no values
    HapticFixture values;
    std::uint32_t seen = 0; ///< the last look at the world that found it

    bool isNamed() const noexcept { return id >= 0; }
    bool isDynamic() const noexcept { return body->GetType() == b2_dynamicBody; }
    /// m_i of Eq. 5.4, kg. During a step.
    double massKg() const noexcept { return isDynamic() ? body->GetMass() : values.staticMassKg; }
    /// Mass that a collision can move, kg; infinite for what is not dynamic. During a step.
    double movableMassKg() const noexcept {
        return isDynamic() ? body->GetMass() : std::numeric_limits<double>::infinity();
    }
};

/// Slots are small and used again; ids are not. Pointers are followed only after refresh() has found them in
/// the world, so a fixture that was destroyed unnoticed does no harm. A new fixture at the address of one
/// that went unnoticed since the last refresh cannot be told from it. Allocates when the world grows. M only.
class FixtureTable {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// Gives values to a fixture, for the first time or again; returns its id: 0, 1, 2... in order of first
    /// calls.
    std::int32_t set(const b2Fixture& fixture, const HapticFixture& values);

    /// The same with an id of the caller's (>= 0), for worlds that have numbered their fixtures themselves.
    void set(const b2Fixture& fixture, const HapticFixture& values, std::int32_t id);

    /// Takes the values away; the fixture stays known, without an id.
    void unset(std::int32_t slot) noexcept;

    /// Frees the slot of a fixture that is gone.
    void release(std::int32_t slot);

    /// Looks at the whole world: adds what is new, brings bodies and masses up to date, and appends to
    /// `vanished` the slots of fixtures that are no more in it.
    void refresh(const b2World& world, std::vector<std::int32_t>& vanished);

    std::int32_t find(const b2Fixture& fixture) const noexcept { return slots_.find(keyOf(&fixture)); }
    const KnownFixture& operator[](std::int32_t slot) const noexcept {
        return known_[static_cast<std::size_t>(slot)];
    }
    std::int32_t size() const noexcept {
        return static_cast<std::int32_t>(known_.size());
    } ///< slots, free ones too

    /// Slots of the cameras, as of the last refresh.
    const std::vector<std::int32_t>& cameras() const noexcept { return cameras_; }

    /// m_max of Eq. 5.7, kg, as of the last refresh: the largest mass of all enabled bodies: their own of
    /// dynamic ones, of others the one given.
    double largestMassKg() const noexcept { return largestMassKg_; }

private:
    static std::uint64_t keyOf(const b2Fixture* fixture) noexcept {
        return reinterpret_cast<std::uintptr_t>(fixture);
    }
    std::int32_t slotOf(const b2Fixture& fixture);
    KnownFixture& at(std::int32_t slot) noexcept { return known_[static_cast<std::size_t>(slot)]; }
    void look(const b2Fixture& fixture, std::int32_t bodyIndex);

    std::vector<KnownFixture> known_;
    std::vector<std::int32_t> free_;
    std::vector<std::int32_t> cameras_;
    IntegerMap slots_;
    std::int32_t nextId_ = 0;
    std::int32_t nextNameless_ = -2;
    std::uint32_t looks_ = 0;
    double largestMassKg_ = 0.0;
};

} // namespace physvib
