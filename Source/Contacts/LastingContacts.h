// SPDX-License-Identifier: MIT
// Contacts that last: what rolls or slides over a rough surface is a train of small blows, one for each grain
// it passes.
#pragma once
#include "Contacts/FixtureTable.h"
#include "Contacts/Grains.h"
#include "Contacts/Impact.h"
#include "Contacts/StepMemory.h"
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// Where a contact point is on a surface at the end of a step, in the surface's own frame, and how fast it
/// moves along it. What lies on a surface with a point of its own, as a corner does, does not move along that
/// one.
struct SurfacePath {
    double metres = 0.0;
    double metresPerSecond = 0.0;
};

/// What an engine tells of a point at which two fixtures went on to touch in a step, after its solver.
/// Fixtures are slots of the FixtureTable.
struct LastingPoint {
    std::int32_t a = 0, b = 0;
    std::uint64_t feature = 0; ///< which of the pair's points; the same from step to step
    double normalNewtonSeconds = 0.0;
    double slipMetresPerSecond = 0.0; ///< of one surface against the other
    Vector2 point;                    ///< world, at the end of the step
    Vector2 metresPerSecond;          ///< of the contact point itself
    SurfacePath onA, onB;
};

/// Follows points from step to step, and makes impacts of the grains that they pass, in any engine's world. A
/// load that has just come is not felt before it has stayed for a step: that is the blow's. Engines move
/// bodies by the velocity at a step's end; the true path of a steady acceleration lies half a step's gain of
/// speed behind that, and this is what is followed, so that times are right far below the length of a step.
///
/// All methods: the world's thread (M). None allocates once it has seen as much as it will.
class LastingContacts {
public:
    /// Slower than this is at rest.
    static constexpr double leastMetresPerSecond = 0.01;
    /// More grains than this in a second are thinned to every second, fourth, eighth... of them, stronger by
    /// its square root: the same power, at a bounded cost.
    static constexpr double mostPerSecond = 2000.0;
    /// All points' together: they are thinned alike, so that a rattling heap costs no more than this.
    static constexpr double mostTogetherPerSecond = 50'000.0;
    static constexpr double longestStepSeconds = 0.1; ///< what moves so far unseen is not followed

    explicit LastingContacts(const FixtureTable& table);

    /// Whether a point of this pair is to be told: somebody feels it, and there is something to feel.
    bool isHeard(std::int32_t a, std::int32_t b) const noexcept {
        return (table_.isRough(a) || table_.isRough(b)) && (table_.isCamera(a) || table_.isCamera(b));
    }

    /// Only paths along rough surfaces are looked at.
    bool isRough(std::int32_t slot) const noexcept { return table_.isRough(slot); }

    /// After the solver; once a step for each point (what is told again is not heard).
    void touch(const LastingPoint& point);
    bool hasHeard() const noexcept { return !points_.now().empty(); }

    /// What the points of the step have passed, by point.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);
    void endStep();

    /// The slot has another owner from now on.
    void forget(std::int32_t slot) noexcept;
    void reset() noexcept;

    /// Grains that were passed and left out, their power being in the others.
    std::uint64_t thinned() const noexcept { return thinned_; }

private:
    struct Told {
        std::uint64_t key = 0;
        LastingPoint point;
        std::int32_t pair = 0, before = 0; // places in pairs_ and in the step before
    };
    struct Pair {
        std::uint64_t key = 0;
        std::int32_t before = 0;
        double newtonSeconds = 0.0, newtons = 0.0; // of all its points in the step
    };
    struct Passage { // of one surface's grains by one point in the step at hand
        const LastingPoint* point;
        std::int32_t surface; // slot
        double loadNewtons;
        SurfaceMotion motion;
        std::int64_t every;
    };

    void follow(const Told& told, std::int32_t surface, SurfacePath LastingPoint::*path, double seconds);
    double steadyShare(const Told& told) const noexcept;
    void thinTogether(double seconds);
    void forgetStep() noexcept;
    void pass(const Passage& passage, const StepSpan& span, std::vector<Impact>& impacts);

    const FixtureTable& table_;
    StepMemory<Told> points_;
    StepMemory<Pair> pairs_;
    std::vector<Passage> passages_;
    std::uint64_t thinned_ = 0;
};

} // namespace physvib
