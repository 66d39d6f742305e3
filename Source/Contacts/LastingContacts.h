// SPDX-License-Identifier: MIT
// Rolling and sliding contacts: each grain of a rough surface that a contact point passes gives a small
// impact.
#pragma once
#include "Contacts/FixtureTable.h"
#include "Contacts/Grains.h"
#include "Contacts/Impact.h"
#include "Contacts/StepMemory.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Position of a contact point on a surface at the end of a step, in the surface's own frame, and its speed
/// along the surface. A corner that slides keeps its position on its own surface.
struct SurfacePath {
    double metres = 0.0;
    double metresPerSecond = 0.0;
};

/// A contact point of two fixtures that continued to touch in a step, as an engine reports it after its
/// solver. Fixtures are slots of the FixtureTable.
struct LastingPoint {
    std::int32_t a = 0, b = 0;
    std::uint64_t feature = 0; ///< identifies the point within the pair; the same from step to step
    double normalNewtonSeconds = 0.0;
    double slipMetresPerSecond = 0.0; ///< of one surface relative to the other
    Vector3 point;                    ///< world, at the end of the step
    Vector3 metresPerSecond;          ///< of the contact point itself
    SurfacePath onA, onB;
};

/// Tracks points from step to step and creates impacts of the grains that they pass, for any engine. A load
/// that is new in this step gives no grains, because it belongs to the collision. Engines move bodies by the
/// velocity at the step's end; under steady acceleration the true path is half a step's change of speed
/// behind that. This path is used, so times are accurate far below a step.
///
/// All methods: the world's thread (M). After its buffers have grown it does not allocate.
class LastingContacts {
public:
    /// Slower contacts count as resting.
    static constexpr double leastMetresPerSecond = 0.01;
    /// More grains per second than this are thinned to every second, fourth, eighth... grain, amplified by
    /// the square root: equal power at bounded cost.
    static constexpr double mostPerSecond = 2000.0;
    /// Limit for all points together, which are thinned alike, so that a rattling heap has bounded cost.
    static constexpr double mostTogetherPerSecond = 50'000.0;
    static constexpr double longestStepSeconds = 0.1; ///< longer steps are not tracked: the motion within is
                                                      ///< not known

    explicit LastingContacts(const FixtureTable& table);

    /// True if points of this pair are to be reported: a surface is rough, and one of the two is a haptic
    /// source.
    bool isRelevant(std::int32_t a, std::int32_t b) const noexcept {
        return (table_.isRough(a) || table_.isRough(b)) && (table_.isCamera(a) || table_.isCamera(b));
    }

    /// Only paths along rough surfaces are used.
    bool isRough(std::int32_t slot) const noexcept { return table_.isRough(slot); }

    /// Reports a point after the solver, once per step; repeated reports of a point are ignored.
    void touch(const LastingPoint& point);
    bool hasHeard() const noexcept { return !points_.now().empty(); }

    /// Appends the impacts of the grains that the step's points passed, by point.
    void collect(const StepSpan& span, std::vector<Impact>& impacts);
    void endStep();

    /// The slot is freed or reassigned.
    void forget(std::int32_t slot) noexcept;
    void reset() noexcept;

    /// Grains left out so far by thinning; the remaining ones carry their power.
    std::uint64_t thinned() const noexcept { return thinned_; }

private:
    struct Told {
        std::uint64_t key = 0;
        LastingPoint point;
        std::int32_t pair = 0, before = 0; // indices into pairs_ and into the last step's points
    };
    struct Pair {
        std::uint64_t key = 0;
        std::int32_t before = 0;
        double newtonSeconds = 0.0, newtons = 0.0; // of all its points in the step
    };
    struct Passage { // the grains of one surface that one point passes in this step
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
