// SPDX-License-Identifier: MIT
// Grains that contact points have passed, and their events: several at a time on processors with vectors.
#pragma once
#include "Contacts/Vectors.h"
#include "Core/CollisionEvent.h"
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Grains of one surface and one haptic source: first which, then with place, time and strength, then as
/// events. Every lane has the operations of a single grain in their order: the same bits with each processor.
struct GrainRuns {
    static constexpr std::size_t mostGrains = 128, mostRuns = 64;

    /// A point's way along the surface, which does not reverse.
    struct alignas(32) Run {
        double start, metresPerSecond, metresPerSecond2, sign; ///< of the motion; sign: of its direction
        double slip, newtons, every, unused;
        std::array<float, 3> point, velocity;
        std::int32_t otherId, unusedToo;
    };

    double seconds, backSeconds, perSecond; ///< of the step
    std::int64_t startNs;
    double lengthNs; ///< below 2^31
    // Of the surface: see Grains and GrainChance. Where grains are regular the weakest is 1, and the range 0
    double leastStrength, strengthRange, rolling, steepness;
    // Of the events: as EventMaker has them
    double perNewtonSecond, divisor, gain, pairGain, relativeAmplitude;
    Vector2 origin;
    float cosine, sine;

    std::size_t runCount = 0, count = 0;
    std::array<Run, mostRuns> runs;
    template <class Value>
    using All = std::array<Value, mostGrains + 4>; // lanes behind the last grain are of no use
    alignas(32) All<double> metres;
    alignas(32) All<std::uint64_t> names; ///< Grains::nameOf
    All<std::uint32_t> runAt;             ///< bytes from the first run to the grain's

    // Of each grain, by compute()
    alignas(32) All<std::int64_t> timeNs;
    alignas(32) All<double> newtonSeconds, amplitude, x, y, z; ///< x, y, z: of the field
    alignas(32) All<std::int64_t> kinds;                       ///< as ContactKind; a hit: too slow to be felt
    /// Bounds of all places in the field, m: x, y.
    std::array<double, 2> least, most;

    void compute() noexcept;
    bool isUsual; ///< by compute(): all are fast enough to be felt, and have usable places and amplitudes

    const Run& runOf(std::size_t grain) const noexcept {
        return *reinterpret_cast<const Run*>(reinterpret_cast<const char*>(runs.data()) + runAt[grain]);
    }
    /// After compute(): makes events of some of them, like `model` otherwise.
    void write(std::size_t first, std::size_t last, const CollisionEvent& model,
               CollisionEvent* to) const noexcept;
};

} // namespace physvib
