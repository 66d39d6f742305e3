// SPDX-License-Identifier: MIT
// Grains that contact points have passed, and their events: several at a time on processors with vectors.
#pragma once
#include "Contacts/Vectors.h"
#include "Core/CollisionEvent.h"
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Grains of one surface and one haptic source. The caller sets keys and places; compute() adds times and
/// impulses, and write() makes events. Each lane computes as for a single grain, with the same bits.
struct GrainRuns {
    static constexpr std::size_t maxGrains = 128, maxRuns = 64;

    /// A point's way along the surface, which does not reverse.
    struct alignas(32) Run {
        double start, metresPerSecond, metresPerSecond2, sign; ///< of the motion; sign: of its direction
        double slip, newtons, every, unused;  ///< slip: m/s; newtons: load; every: one of so many grains
        std::array<float, 3> point, velocity; ///< of the contact point at the step's end, m, m/s, world
        std::int32_t otherId, unusedToo;
    };

    double seconds, backSeconds, perSecond; ///< of the step: length, 1.5 lengths, 1 / length
    std::int64_t startNs;
    double lengthNs; ///< below 2^31
    // Of the surface: see Grains and GrainChance. For regular grains minStrength is 1, the range 0
    double minStrength, strengthRange, rolling, steepness;
    // Of the events: EventMaker's factors
    double perNewtonSecond, divisor, gain, pairGain, relativeAmplitude;
    Vector2 origin;
    float cosine, sine;

    std::size_t runCount = 0, count = 0;
    std::array<Run, maxRuns> runs;
    template <class Value>
    using All = std::array<Value, maxGrains + 4>; // the last vector may reach beyond the last grain
    alignas(32) All<double> metres;
    alignas(32) All<std::uint64_t> keys; ///< Grains::keyOf
    All<std::uint32_t> runOffsets;       ///< bytes from the first run to the grain's

    // Of each grain, by compute()
    alignas(32) All<std::int64_t> timeNs;
    alignas(32) All<double> newtonSeconds, amplitude, x, y, z; ///< x, y, z: of the field
    alignas(32) All<std::int64_t> kinds;                       ///< as ContactKind; a hit: too slow to be felt
    /// Bounds of all places in the field, m: x, y.
    std::array<double, 2> minPlace, maxPlace;

    void compute() noexcept;
    bool isPlayable; ///< by compute(): all are fast enough to be felt, and have usable places and amplitudes

    const Run& runOf(std::size_t grain) const noexcept {
        return *reinterpret_cast<const Run*>(reinterpret_cast<const char*>(runs.data()) + runOffsets[grain]);
    }
    /// After compute(): makes events of some of them, like `model` otherwise.
    void write(std::size_t first, std::size_t last, const CollisionEvent& model,
               CollisionEvent* target) const noexcept;
};

} // namespace physvib
