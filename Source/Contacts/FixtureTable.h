// SPDX-License-Identifier: MIT
// The fixtures of a world that have values or touch something, beside the world, whose user data stay the
// user's.
#pragma once
#include "Contacts/BodyReader.h"
#include "Contacts/HapticFixture.h"
#include "Contacts/IntegerMap.h"
#include "Contacts/NameSketch.h"
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace physvib {

/// One fixture of the world.
struct KnownFixture {
    std::uint64_t fixture = 0; ///< the engine's name; 0: the slot is free
    BodyFacts body;            ///< as of the last contact that began
    std::int32_t id = 0;       ///< in events; below -1: the user has given it no values
    HapticFixture values;
    Vector2 centre; ///< of its mass, in the body's frame; of fixtures with values

    bool isUsed() const noexcept { return fixture != 0; }
    bool isNamed() const noexcept { return id >= 0; }
    bool isDynamic() const noexcept { return body.isDynamic; }
    /// m_i of Eq. 5.4, kg.
    double massKg() const noexcept { return isDynamic() ? body.massKg : values.staticMassKg; }
    /// How much of the world's gravity it rests with.
    float gravityScale() const noexcept { return isDynamic() ? std::abs(body.gravityScale) : 0.0F; }
    /// Mass that a collision can move, kg; infinite for what is not dynamic.
    double movableMassKg() const noexcept {
        return isDynamic() ? body.massKg : std::numeric_limits<double>::infinity();
    }
};

/// Slots are small and used again; ids are not. A fixture is known once it has values or has touched another,
/// so what a step costs does not grow with a map that lies still. Allocates when it gets to know more than it
/// ever did. M only.
class FixtureTable {
public:
    static constexpr std::int32_t none = IntegerMap::none;

    /// The slot of a fixture, a new one if need be; `body` is what is known of its body from now on.
    std::int32_t know(std::uint64_t fixture, const BodyFacts& body);
    void know(std::int32_t slot, const BodyFacts& body); ///< of one that is known

    /// Gives values to a known fixture, for the first time or again; `id` is the caller's (>= 0), or `none`:
    /// the one it has, else the next of 0, 1, 2... Returns the id; `none`, and nothing is changed, if another
    /// fixture has it.
    std::int32_t set(std::int32_t slot, const HapticFixture& values, Vector2 centre, std::int32_t id = none);

    /// Takes the values away; the fixture stays known, without an id.
    void unset(std::int32_t slot);

    /// Frees the slot of a fixture that is gone.
    void release(std::int32_t slot);

    std::int32_t find(std::uint64_t fixture) const noexcept { return slots_.find(fixture); }
    const KnownFixture& operator[](std::int32_t slot) const noexcept {
        return known_[static_cast<std::size_t>(slot)];
    }
    bool isCamera(std::int32_t slot) const noexcept { return isCamera_[static_cast<std::size_t>(slot)] != 0; }
    /// By the engine's name, without a search: false is certain.
    bool mayBeCamera(std::uint64_t fixture) const noexcept { return cameraNames_.mayHave(fixture); }
    bool isRough(std::int32_t slot) const noexcept { return isRough_[static_cast<std::size_t>(slot)] != 0; }

    /// Two numbers of its KnownFixture.
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

    /// The largest mass that has been given to a fixture of a body that is not dynamic, and enabled now, kg.
    double largestStaticMassKg(const BodyReader& bodies);

private:
    KnownFixture& at(std::int32_t slot) noexcept { return known_[static_cast<std::size_t>(slot)]; }
    void lose(std::int32_t slot);
    void noteBody(std::int32_t slot, const BodyFacts& body) noexcept;
    void noteCamera(std::int32_t slot, bool isCamera) noexcept;
    void weigh(const KnownFixture& known);

    std::vector<KnownFixture> known_;
    std::vector<std::uint8_t> isCamera_; // by slot, as the next two: asked of each contact in each step, so
                                         // they are kept close together
    std::vector<Mobility> mobility_;
    std::vector<std::uint8_t> isRough_;
    std::int32_t cameras_ = 0;
    NameSketch cameraNames_;
    std::vector<std::int32_t> free_;
    IntegerMap slots_;    // by the engine's name of the fixture
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
