// SPDX-License-Identifier: MIT
// One collision as the renderer needs it: the thesis' L_col node (Eq. 5.1, 6.2), the only type on this edge.
#pragma once
#include "Core/ClipNumber.h"
#include "Core/Limits.h"
#include "Core/Spread.h"
#include <cmath>
#include <cstdint>

namespace physvib {

/// What an event came of: two bodies that met, or a grain of a surface that something rolled or slid over.
enum class ContactKind : std::uint8_t { hit, roll, slide };

/// Who hit whom, and how hard. Not needed for rendering; carried along for event lists, views and studies.
struct CollisionSource {
    std::int32_t fixture = -1;           ///< camera-focused fixture that vibrates; -1: unknown
    std::int32_t other = -1;             ///< the fixture it collided with; -1: unknown
    double impulseNewtonSeconds = 0.0;   ///< 0: unknown
    double massKg = 0.0;                 ///< of the body that carries `fixture`
    ContactKind kind = ContactKind::hit; ///< hit, or grain
    bool operator==(const CollisionSource&) const = default; ///< Member by member.
};

/// By what a strike differs from a hit: it may go somewhere, be spread in its own way, and be the rest of a
/// longer tone.
struct StrikeCourse {
    /** Its end. */ double toX = 0.0, toY = 0.0; ///< metres of the field; where it is after travelNs, in a
                                                 ///< straight line at one speed
    std::int64_t travelNs = 0;                   ///< 0: it stays where it is struck
    std::int64_t sinceNs = 0;       ///< the tone began that long before: phase and decay go on from there
    Spread spread = Spread::layout; ///< over the enchanters
    bool operator==(const StrikeCourse&) const = default; ///< Member by member.
};

/// x(t) = amplitude sin(2 pi frequencyHz t) exp(-decayPerSecond t), t = time since `timeNs` (Eq. 5.1).
struct CollisionEvent {
    std::int64_t timeNs = 0;     ///< onset, nanoseconds since the session began; between frames as a rule
    double frequencyHz = 0.0;    ///< above 0, to limits::maxFrequencyHz
    double decayPerSecond = 0.0; ///< 0 to limits::maxDecayPerSecond; 0 needs a duration; below
                                 ///< limits::slowestToneHz at least limits::slowDecayPerSecond
    double amplitude = 0.0;      ///< 1 = full scale of an enchanter
    double x = 0.0;              ///< place of the hit in metres of the field, origin lower left
    double y = 0.0;              ///< upwards
    std::int64_t durationNs = 0; ///< 0: until it has decayed; else the vibration is cut after this time
    CollisionSource source;      ///< whom it came of
    StrikeCourse course{};       ///< of what is struck apart from a world
    bool operator==(const CollisionEvent&) const = default; ///< Member by member.
};

/// True if it would hold a coil at nearly direct current: slower than limits::slowestToneHz, and hardly
/// decaying. A clip that stays where it is has samples instead of a tone. Any thread.
inline bool isTooSlow(const CollisionEvent& e) noexcept {
    return e.frequencyHz < limits::slowestToneHz && e.decayPerSecond < limits::slowDecayPerSecond &&
           !(isClip(e.frequencyHz) && e.course.travelNs == 0);
}

/// True if the event can be played: finite, inside `limits`, not isTooSlow, and sure to end (a decay or a
/// duration). Any thread.
inline bool isPlayable(const CollisionEvent& e) noexcept {
    const bool inTime = e.timeNs >= 0 && e.timeNs <= limits::maxTimeNs && e.durationNs >= 0 &&
                        e.durationNs <= limits::maxTimeNs;
    const bool audible = e.frequencyHz > 0.0 && e.frequencyHz <= limits::maxFrequencyHz &&
                         e.decayPerSecond >= 0.0 && e.decayPerSecond <= limits::maxDecayPerSecond &&
                         std::abs(e.amplitude) <= limits::maxAmplitude;
    const bool ends = e.decayPerSecond > 0.0 || e.durationNs > 0;
    const StrikeCourse& c = e.course;
    const bool goes = c.travelNs >= 0 && c.travelNs <= limits::maxTimeNs && c.sinceNs >= 0 &&
                      c.sinceNs <= limits::maxTimeNs && std::isfinite(c.toX) && std::isfinite(c.toY);
    return inTime && audible && ends && goes && !isTooSlow(e) && std::isfinite(e.x) && std::isfinite(e.y);
}

} // namespace physvib
