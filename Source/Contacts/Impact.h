// SPDX-License-Identifier: MIT
// What contact stages read (BodyReader) and pass on: the step, collisions, ended contacts, and impacts.
#pragma once
#include "Contacts/Vectors.h"
#include "Core/CollisionEvent.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace physvib {

/// Properties of a body. Fixtures and bodies are identified by numbers of the engine's choice (addresses,
/// ids): not 0, and unique among those that exist at the same time.
struct BodyFacts {
    std::uint64_t body = 0;
    double massKg = 0.0;       ///< of a dynamic body
    float gravityScale = 1.0F; ///< factor on the world's gravity
    bool isDynamic = false;
    bool isEnabled = true;
};

/// Reads bodies from the engine. It is asked only for the few to which something has happened, so nothing is
/// copied for those at rest. World thread (M), within a step or right after it, for bodies in the world.
class BodyReader {
public:
    virtual ~BodyReader() = default;

    virtual BodyFacts facts(std::uint64_t body) const = 0;

    /// The current motion, and the motion at the beginning of the step. These, the centre and the moment of
    /// inertia are those of the plane: `release` timing uses them.
    virtual BodyMotion motion(std::uint64_t body) const = 0;
    virtual BodyMotion motionBefore(std::uint64_t body) const = 0;

    /// Centre of mass, m, world; and the world position of a point given in the body's frame.
    virtual Vector2 centre(std::uint64_t body) const = 0;
    virtual Vector3 toWorld(std::uint64_t body, Vector2 local) const = 0;

    /// Moment of inertia about the centre of mass, kg m^2.
    virtual double inertia(std::uint64_t body) const = 0;
};

/// A step of the world in session time, and the thresholds for impacts in it.
struct StepSpan {
    std::int64_t earliestNs = 0; ///< start of the step before: contacts may be reported up to a step late
    std::int64_t startNs = 0;
    std::int64_t endNs = 0;
    double minThresholdMetresPerSecond = 0.0; ///< ImpactSettings::thresholdMetresPerSecond
    Vector2 gravityMetresPerSecond2;

    /// Rounds to nearest, halves away from zero, like std::llround; inline, because it runs for each grain.
    static std::int64_t roundedNs(double ns) noexcept {
        const auto whole = static_cast<std::int64_t>(ns);
        const double rest = ns - static_cast<double>(whole); // exact
        return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
    }
    double seconds() const noexcept { return static_cast<double>(endNs - startNs) * 1.0e-9; }
    /// Time of a fraction of the step. Fractions below 0 count in the step before, of its own length.
    std::int64_t timeNs(double fraction) const noexcept {
        const std::int64_t lengthNs = fraction < 0.0 ? startNs - earliestNs : endNs - startNs;
        const double sinceStart = fraction * static_cast<double>(lengthNs);
        return std::max(earliestNs, startNs + roundedNs(sinceStart));
    }

    /// timeNs() of a fraction that is not below 0; inline, because it runs for each grain.
    std::int64_t timeNsAfterStart(double fraction) const noexcept {
        const double sinceStart = fraction * static_cast<double>(endNs - startNs);
        const auto whole = static_cast<std::int64_t>(sinceStart);
        return startNs + whole + (sinceStart - static_cast<double>(whole) >= 0.5 ? 1 : 0);
    }

    /// Change of velocity by which a collision counts as an impact. At least 1.5 g dt: a resting body gets g
    /// dt in every step, and a jittering contact more.
    double thresholdMetresPerSecond(float gravityScale) const noexcept {
        constexpr double restingSteps = 1.5;
        const double g = static_cast<double>(gravityMetresPerSecond2.length()) *
                         std::abs(static_cast<double>(gravityScale));
        return std::max(minThresholdMetresPerSecond, restingSteps * g * seconds());
    }
    /// Approach speed from which surfaces collide: two thirds of the threshold. With a restitution of 0.5
    /// that gives just the threshold, and it is what a resting body may gain in a step.
    double minApproachMetresPerSecond(float gravityScale) const noexcept {
        return thresholdMetresPerSecond(gravityScale) / 1.5;
    }

    /// The impulse, N s, that changes the lighter body's velocity by the threshold.
    double minNewtonSeconds(double lighterMassKg, float gravityScale) const noexcept {
        return thresholdMetresPerSecond(gravityScale) * lighterMassKg;
    }
    /// True if an impulse is above 0 and at least `minNewtonSeconds`.
    static bool isImpact(double newtonSeconds, double minNewtonSeconds) noexcept {
        return newtonSeconds > 0.0 && newtonSeconds >= minNewtonSeconds;
    }
    bool isImpact(double newtonSeconds, double lighterMassKg, float gravityScale) const noexcept {
        return isImpact(newtonSeconds, minNewtonSeconds(lighterMassKg, gravityScale));
    }
};

/// A collision: two fixtures whose parts were apart and meet in this step, faster than resting bodies do.
/// Fixtures are slots of the FixtureTable.
struct Collision {
    std::int32_t a = 0, b = 0;
    std::int32_t pair = 0;     // number of the pair
    std::int32_t order = 0;    // order of collisions and ended contacts within the step
    float gravityScale = 1.0F; // the larger one of the two bodies
    Vector3 point;             // world
    double fraction = 0.0;     // time of touch in steps after the start of this step, -1 (start of the one
                               // before) to 1
    double lighterMassKg = 0.0;
    double expectedNewtonSeconds = 0.0; // estimate from approach speed and lighter mass, before the solver
    BodyMotion motionA, motionB;        // before the solver; these two for `release` timing, which is planar
    Vector2 armA, armB;                 // from the centre of mass to the point
    double normalNewtonSeconds = 0.0, tangentialNewtonSeconds = 0.0; // N s, of the parts that met, summed
                                                                     // over the solver passes of the step
    Vector3 frictionNewtonSeconds; // of engines that report it as a vector, instead of
                                   // tangentialNewtonSeconds

    double impulse() const noexcept {
        // hypot of a 0 is exact, so a world in the plane keeps its bits
        const auto friction = static_cast<double>(frictionNewtonSeconds.length());
        return portable::hypot(normalNewtonSeconds, portable::hypot(tangentialNewtonSeconds, friction));
    }
};

/// A contact that ended.
struct ContactEnd {
    std::int32_t a = 0, b = 0;
    std::int32_t order = 0;
    double fraction = 0.0;
    BodyMotion motionA, motionB;
};

/// An impact that a haptic source received: |J_i| of Eq. 5.4, time and place.
struct Impact {
    std::int32_t source; // slot of the haptic source
    std::int32_t other;  // slot of the fixture that touches it there, or FixtureTable::none
    std::int64_t timeNs;
    double newtonSeconds;
    Vector3 point;
    ContactKind kind = ContactKind::hit;
};

} // namespace physvib
