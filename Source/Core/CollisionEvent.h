// SPDX-License-Identifier: MIT
// A collision event as the renderer plays it (the thesis' node L_col, Eq. 5.1, 6.2), its source and its
// course. The physics side passes nothing else to the renderer.
#pragma once
#include "Core/Limits.h"
#include "Core/NameNumbers.h"
#include "Core/PanningLaws.h"
#include <cmath>
#include <cstdint>

namespace physvib {

/// What caused an event: the impact of two bodies, or one roughness element (grain) of a surface that a body
/// rolled or slid over.
enum class ContactKind : std::uint8_t { hit, roll, slide };

/// The two fixtures of a collision, and how hard it was. Rendering does not need it; event lists, views and
/// studies do.
struct CollisionSource {
    std::int32_t fixture = -1;           ///< fixture that is a haptic source; -1: unknown
    std::int32_t other = -1;             ///< the fixture it collided with; -1: unknown
    double impulseNewtonSeconds = 0.0;   ///< 0: unknown
    double massKg = 0.0;                 ///< of the body that carries `fixture`
    ContactKind kind = ContactKind::hit; ///< impact, or grain
    PartNumber part = 0; ///< part of the body on whose actuators it is felt; 0: on all, by its place
    bool operator==(const CollisionSource&) const = default; ///< Compares all members.
};

/// Optional properties of an event: it may move, and continue a tone that began earlier.
struct ToneCourse {
    /** End point along x, m. */ double toX = 0.0, toY = 0.0; ///< end point, m of the field; reached after
                                                              ///< travelNs, straight and at constant speed
    std::int64_t travelNs = 0;                                ///< 0: it stays at its starting point
    std::int64_t toneAgeNs = 0; ///< age of the tone at the onset: phase and decay continue from there
    double toZ = 0.0;           ///< end point across the plane, m; 0 in a world in a plane
    bool operator==(const ToneCourse&) const = default; ///< Compares all members.
};

/// x(t) = amplitude sin(2 pi frequencyHz t) exp(-decayPerSecond t), t = time since `timeNs` (Eq. 5.1).
struct CollisionEvent {
    std::int64_t timeNs = 0;     ///< onset, nanoseconds since the session began; usually between two frames
    double frequencyHz = 0.0;    ///< above 0, at most limits::maxFrequencyHz
    double decayPerSecond = 0.0; ///< 0 to limits::maxDecayPerSecond; 0 needs a duration; below
                                 ///< limits::slowestToneHz at least limits::slowDecayPerSecond
    double amplitude = 0.0;      ///< 1 = full scale of an actuator
    double x = 0.0;              ///< place of the impact in metres of the field, origin lower left
    double y = 0.0;              ///< metres, upwards
    std::int64_t durationNs = 0; ///< 0: until it has decayed; else the vibration is cut after this time
    CollisionSource source;      ///< the bodies that caused it
    ToneCourse course{};         ///< for events that no world produced
    Spread spread = Spread::layout; ///< how it is distributed over the actuators
    SoundNumber sound = 0;          ///< the recording that plays it; 0, or if there is none: its frequency
    double z = 0.0;                 ///< place across the plane of x and y, m; 0 in a world in a plane
    bool operator==(const CollisionEvent&) const = default; ///< Compares all members.
};

/// True if the event would drive a coil with nearly direct current: it is slower than limits::slowestToneHz
/// and hardly decays. Any thread.
inline bool isTooSlow(const CollisionEvent& e) noexcept {
    return e.frequencyHz < limits::slowestToneHz && e.decayPerSecond < limits::slowDecayPerSecond;
}

/// True if the event can be played: finite, inside `limits`, not isTooSlow, ended by a decay or a duration,
/// and no clip that moves. Any thread.
inline bool isPlayable(const CollisionEvent& e) noexcept {
    const bool isInTime = e.timeNs >= 0 && e.timeNs <= limits::maxTimeNs && e.durationNs >= 0 &&
                          e.durationNs <= limits::maxTimeNs;
    const bool isInRange = e.frequencyHz > 0.0 && e.frequencyHz <= limits::maxFrequencyHz &&
                           e.decayPerSecond >= 0.0 && e.decayPerSecond <= limits::maxDecayPerSecond &&
                           std::abs(e.amplitude) <= limits::maxAmplitude;
    const bool hasEnd = e.decayPerSecond > 0.0 || e.durationNs > 0;
    const ToneCourse& c = e.course;
    const bool isCourseValid = c.travelNs >= 0 && c.travelNs <= limits::maxTimeNs && c.toneAgeNs >= 0 &&
                               c.toneAgeNs <= limits::maxTimeNs && std::isfinite(c.toX) &&
                               std::isfinite(c.toY) && std::isfinite(c.toZ);
    const bool isSound = e.sound >= 0 && !(isClip(e.sound) && c.travelNs > 0);
    return isInTime && isInRange && hasEnd && isCourseValid && isSound && !isTooSlow(e) &&
           std::isfinite(e.x) && std::isfinite(e.y) && std::isfinite(e.z);
}

/// The event, moved to its place after `share` (0 to 1) of its way. Any thread.
inline CollisionEvent movedAlong(CollisionEvent e, double share) noexcept {
    e.x += share * (e.course.toX - e.x);
    e.y += share * (e.course.toY - e.y);
    e.z += share * (e.course.toZ - e.z);
    return e;
}

} // namespace physvib
