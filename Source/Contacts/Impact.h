// SPDX-License-Identifier: MIT
// What the catcher's stages hand to each other: the step, the blows that fell in it, and what a camera felt.
#pragma once
#include "Contacts/BodyReader.h"
#include "Core/CollisionEvent.h"
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace physvib {

/// A step of the world in session time, and what it takes to be a strike in it.
struct StepSpan {
    std::int64_t earliestNs = 0; ///< start of the step before: contacts are noticed up to a step late
    std::int64_t startNs = 0;
    std::int64_t endNs = 0;
    double leastMetresPerSecond = 0.0; ///< ImpactSettings::thresholdMetresPerSecond
    Vector2 gravityMetresPerSecond2;

    /// The nearest whole number, halves away from zero: as std::llround, which is a call for each grain.
    static std::int64_t roundedNs(double ns) noexcept {
        const auto whole = static_cast<std::int64_t>(ns);
        const double rest = ns - static_cast<double>(whole); // exact
        return whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0);
    }
    double seconds() const noexcept { return static_cast<double>(endNs - startNs) * 1.0e-9; }
    /// Time of a moment given in steps after the start: below 0 in parts of the step before, which may have
    /// had another length.
    std::int64_t timeNs(double fraction) const noexcept {
        const std::int64_t lengthNs = fraction < 0.0 ? startNs - earliestNs : endNs - startNs;
        const double sinceStart = fraction * static_cast<double>(lengthNs);
        return std::max(earliestNs, startNs + roundedNs(sinceStart));
    }

    /// By how much a blow must change the velocity of a body that gravity pulls so much: more than resting
    /// does, which gives it g dt in every step, and more than that when a contact trembles.
    double thresholdMetresPerSecond(float gravityScale) const noexcept {
        constexpr double restingSteps = 1.5;
        const double g = static_cast<double>(gravityMetresPerSecond2.length()) *
                         std::abs(static_cast<double>(gravityScale));
        return std::max(leastMetresPerSecond, restingSteps * g * seconds());
    }
    /// How fast two surfaces must near each other for a blow: two thirds of the same, which is the least that
    /// gives as much with a restitution of a half, and what a resting body may gain in a step.
    double leastApproach(float gravityScale) const noexcept {
        return thresholdMetresPerSecond(gravityScale) / 1.5;
    }

    /// True if an impulse moves the lighter body by more than resting does.
    bool isStrike(double newtonSeconds, double lighterMassKg, float gravityScale) const noexcept {
        return newtonSeconds > 0.0 && newtonSeconds >= thresholdMetresPerSecond(gravityScale) * lighterMassKg;
    }
};

/// Two fixtures of which parts that were apart meet in this step, faster than resting bodies do. Fixtures are
/// slots of the FixtureTable.
struct Blow {
    std::int32_t a = 0, b = 0;
    std::int32_t pair = 0;     // their number
    std::int32_t order = 0;    // of blows and ends within the step
    float gravityScale = 1.0F; // the larger one of the two bodies
    Vector2 point;             // world
    double fraction = 0.0;     // moment of touch in steps after the start of this step, -1 (start of the one
                               // before) to 1
    double lighterMassKg = 0.0;
    double expectedNewtonSeconds = 0.0;                  // by approach and lighter mass, before the solver
    BodyMotion motionA, motionB;                         // before the solver
    Vector2 armA, armB;                                  // from the centre of mass to the point
    double normalImpulse = 0.0, tangentialImpulse = 0.0; // N s, of the parts that met, summed over the passes
                                                         // of the step

    double impulse() const noexcept { return std::hypot(normalImpulse, tangentialImpulse); }
};

/// A contact that ended.
struct ContactEnd {
    std::int32_t a = 0, b = 0;
    std::int32_t order = 0;
    double fraction = 0.0;
    BodyMotion motionA, motionB;
};

/// What a camera felt of a contact: |J_i| of Eq. 5.4, when and where.
struct Impact {
    std::int32_t camera; // slot
    std::int32_t other;  // slot of what touches the camera there, or FixtureTable::none
    std::int64_t timeNs;
    double newtonSeconds;
    Vector2 point;
    ContactKind kind = ContactKind::hit;
};

} // namespace physvib
