// SPDX-License-Identifier: MIT
// The fixtures of a world and what PhysVib knows of them, beside the world, whose user data stay the user's.
#pragma once
#include "Contacts/HapticFixture.h"
#include "Contacts/IntegerMap.h"
#include <cstdint>
#include <limits>
#include <vector>

namespace physvib {

/// What the engine says of a fixture and its body. Fixtures and bodies are named by numbers of the engine's choice
/// (addresses, ids): not 0, and different for those that are in the world at the same time.
struct FixtureFacts {
    std::uint64_t fixture = 0;
    std::uint64_t body = 0;
    std::int32_t bodyIndex = 0; ///< 0, 1, 2... of the body in this step
    double bodyMassKg = 0.0;    ///< of a dynamic body
    bool isDynamic = false;
};

/// One fixture of the world.
struct KnownFixture {
    FixtureFacts facts;                 ///< facts.fixture 0: the slot is free
    std::int32_t id = 0;                ///< in events; below -1: the user has given it no values
    HapticFixture values;
    std::uint32_t seen = 0; ///< the last look at the world that found it

    bool isUsed() const noexcept { return facts.fixture != 0; }
    bool isNamed() const noexcept { return id >= 0; }
    bool isDynamic() const noexcept { return facts.isDynamic; }
    /// m_i of Eq. 5.4, kg.
    double massKg() const noexcept { return isDynamic() ? facts.bodyMassKg : values.staticMassKg; }
    /// Mass that a collision can move, kg; infinite for what is not dynamic.
    double movableMassKg() const noexcept {
        return isDynamic() ? facts.bodyMassKg : std::numeric_limits<double>::infinity();
    }
};

/// Slots are small and used again; ids are not. A fixture that is destroyed unnoticed does no harm: nothing is asked of
/// one that the last look has not found. A new fixture by the name of one that went unnoticed since the last look
/// cannot be told from it. Allocates when the world grows. M only.
class FixtureTable {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// Gives values to a fixture, for the first time or again; returns its id: 0, 1, 2... in order of first
    /// calls.
    std::int32_t set(const FixtureFacts& facts, const HapticFixture& values);

    /// The same with an id of the caller's (>= 0), for worlds that have numbered their fixtures themselves.
    void set(const FixtureFacts& facts, const HapticFixture& values, std::int32_t id);

    /// Takes the values away; the fixture stays known, without an id.
    void unset(std::int32_t slot) noexcept;

    /// Frees the slot of a fixture that is gone.
    void release(std::int32_t slot);

    /// A look at the whole world before each step: begin, every fixture (new ones are added), and at the end the
    /// slots of those that were not seen, appended to `vanished`. A disabled body's mass does not count for m_max.
    void beginLook() noexcept;
    void look(const FixtureFacts& facts, bool isEnabled);
    void endLook(std::vector<std::int32_t>& vanished) const;

    std::int32_t find(std::uint64_t fixture) const noexcept { return slots_.find(fixture); }
    const KnownFixture& operator[](std::int32_t slot) const noexcept {
        return known_[static_cast<std::size_t>(slot)];
    }
    std::int32_t size() const noexcept {
        return static_cast<std::int32_t>(known_.size());
    } ///< slots, free ones too

    /// Slots of the cameras, as of the last look.
    const std::vector<std::int32_t>& cameras() const noexcept { return cameras_; }

    /// m_max of Eq. 5.7, kg, as of the last look: the largest mass of all enabled bodies: their own of
    /// dynamic ones, of others the one given.
    double largestMassKg() const noexcept { return largestMassKg_; }

private:
    std::int32_t slotOf(const FixtureFacts& facts);
    KnownFixture& at(std::int32_t slot) noexcept { return known_[static_cast<std::size_t>(slot)]; }

    std::vector<KnownFixture> known_;
    std::vector<std::int32_t> free_;
    std::vector<std::int32_t> cameras_;
    IntegerMap slots_; // by the engine's name of the fixture
    std::int32_t nextId_ = 0;
    std::int32_t nextNameless_ = -2;
    std::uint32_t looks_ = 0;
    double largestMassKg_ = 0.0;
};

} // namespace physvib
