// SPDX-License-Identifier: MIT
// Table of the fixtures that have haptic values or touch something. It is kept beside the physics world, so
// the engine's user data remain the user's.
#pragma once
#include "Contacts/HapticFixture.h"
#include "Contacts/Impact.h"
#include "Contacts/IndexMaps.h"
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace physvib {

/// One fixture of the world.
struct KnownFixture {
    std::uint64_t fixture = 0; ///< the engine's number; 0: the slot is free
    BodyFacts body;            ///< at the last contact that began
    std::int32_t id = 0;       ///< id in events; below -1: no haptic values
    HapticFixture values;
    Vector2 centre; ///< centre of mass in the body's frame; for fixtures with values

    bool isUsed() const noexcept { return fixture != 0; }
    bool isNamed() const noexcept { return id >= 0; }
    bool isDynamic() const noexcept { return body.isDynamic; }
    /// m_i of Eq. 5.4, kg.
    double massKg() const noexcept { return isDynamic() ? body.massKg : values.staticMassKg; }
    /// Factor of the gravity that acts on it.
    float gravityScale() const noexcept { return isDynamic() ? std::abs(body.gravityScale) : 0.0F; }
    /// Mass that a collision can move, kg; infinite if the body is not dynamic.
    double movableMassKg() const noexcept {
        return isDynamic() ? body.massKg : std::numeric_limits<double>::infinity();
    }
};

/// Slots are small and reused; ids are not. A fixture is registered once it has values or has touched
/// another, so a step's cost does not grow with static geometry that nothing touches. Allocates only to grow.
/// World thread (M) only.
class FixtureTable {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// The slot of a fixture, a new one if necessary; `body` replaces what is stored of its body.
    std::int32_t know(std::uint64_t fixture, const BodyFacts& body);
    void know(std::int32_t slot, const BodyFacts& body); ///< updates a registered fixture

    /// Assigns values to a registered fixture, or replaces them. `id`: the caller's (>= 0), or `none`: its
    /// present one, else the next of 0, 1, 2... Returns the id; `none`, and nothing is changed, if another
    /// fixture has it.
    std::int32_t set(std::int32_t slot, const HapticFixture& values, Vector2 centre, std::int32_t id = none);

    /// Removes the values; the fixture stays registered, without an id.
    void unset(std::int32_t slot);

    /// Frees the slot of a destroyed fixture.
    void release(std::int32_t slot);

    std::int32_t find(std::uint64_t fixture) const noexcept { return slots_.find(fixture); }
    const KnownFixture& operator[](std::int32_t slot) const noexcept {
        return known_[static_cast<std::size_t>(slot)];
    }
    bool isCamera(std::int32_t slot) const noexcept { return isCamera_[static_cast<std::size_t>(slot)] != 0; }
    /// By the engine's number, without a search; false is certain.
    bool mayBeCamera(std::uint64_t fixture) const noexcept { return cameraNames_.mayHave(fixture); }
    bool isRough(std::int32_t slot) const noexcept { return isRough_[static_cast<std::size_t>(slot)] != 0; }

    /// Two properties of KnownFixture that are read often.
    struct Mobility {
        double movableMassKg = std::numeric_limits<double>::infinity();
        float gravityScale = 0.0F;
    };
    const Mobility& mobility(std::int32_t slot) const noexcept {
        return mobility_[static_cast<std::size_t>(slot)];
    }
    bool hasCameras() const noexcept { return cameras_ > 0; }
    std::int32_t size() const noexcept {
        return static_cast<std::int32_t>(known_.size());
    } ///< slots, free ones too

    /// The largest staticMassKg of fixtures whose body is enabled and not dynamic, kg.
    double largestStaticMassKg(const BodyReader& bodies);

private:
    KnownFixture& at(std::int32_t slot) noexcept { return known_[static_cast<std::size_t>(slot)]; }
    void lose(std::int32_t slot);
    void noteBody(std::int32_t slot, const BodyFacts& body) noexcept;
    void noteCamera(std::int32_t slot, bool isCamera) noexcept;
    void weigh(const KnownFixture& known);

    std::vector<KnownFixture> known_;
    std::vector<std::uint8_t> isCamera_; // by slot, as the next two: read for each contact in each step, so
                                         // kept compact
    std::vector<Mobility> mobility_;
    std::vector<std::uint8_t> isRough_;
    std::int32_t cameras_ = 0;
    NameSketch cameraNames_;
    std::vector<std::int32_t> free_;
    IntegerMap slots_;    // by the engine's fixture number
    IntegerMap slotOfId_; // by id + 1
    std::int32_t nextId_ = 0;
    std::int32_t nextNameless_ = -2;

    struct StaticBody {
        std::uint64_t body;
        double massKg; // the largest of its fixtures
    };
    std::vector<StaticBody> staticBodies_;
    IntegerMap staticBodyOf_; // by body
    bool isWeightStale_ = false;
};

} // namespace physvib
