// SPDX-License-Identifier: MIT
// Explains why a render would be silent, so that the programs do not report success.
#pragma once
#include "Scene/FieldSize.h"
#include <cstdint>

namespace physvib {

/// Empty if an event that begins before `endNs` exceeds `least`, of full scale, at one actuator; else the
/// reason. Any thread.
inline std::string silentWords(std::span<const CollisionEvent> events, const PhantomPanner& panner,
                               bool isGuessed, std::int64_t endNs, double least = 0.0) {
    PhantomPanner::Gains gains{};
    bool begins = false;
    double strongest = 0.0, most = 0.0; // as struck; at the actuators
    for (const CollisionEvent& e : events) {
        if (e.timeNs >= endNs) continue;
        begins = true;
        strongest = std::max(strongest, std::abs(e.amplitude));
        panner.gainsAt(e, gains);
        for (std::size_t j = 0; j < static_cast<std::size_t>(panner.channels()); ++j)
            most = std::max(most, std::abs(e.amplitude * gains[j]));
    }
    if (most > least) return {};
    if (events.empty()) return "there are no hits";
    if (!begins) return "all hits begin after the end";
    if (!(strongest > least)) return "the strongest hit is " + fixedNumber(strongest, 6) + " of full scale";
    const std::string outside = outsideWarning(events, fieldOf(panner), isGuessed);
    return outside.empty() ? "all hits lie where they reach no actuator" : outside;
}

} // namespace physvib
