// SPDX-License-Identifier: MIT
// What becomes of a collision before it is rendered: the method, then the frequencies that the actuators can play, then the level.
#pragma once
#include "Core/Actuators/PerceivedLevel.h"
#include "Core/RenderingMethod.h"
#include "Core/Actuators/Resonator.h"
#include <algorithm>
#include <cmath>

namespace physvib {

/// Moves what is felt into a band, in its order: frequencies a musical interval apart stay an interval apart, only a
/// smaller one. The same for every list of events, so that live and offline agree. Any thread.
struct FrequencyRemap {
    static constexpr double feltLowHz = 20.0, feltHighHz = 1000.0; ///< go to the band's ends; what lies beyond, too
    FrequencyBand band;                                            ///< not known: nothing is moved

    double operator()(double frequencyHz) const noexcept {
        if (!band.isKnown()) return frequencyHz;
        const double place = std::log(frequencyHz / feltLowHz) / std::log(feltHighHz / feltLowHz);
        return band.lowHz * std::pow(band.highHz / band.lowHz, std::clamp(place, 0.0, 1.0));
    }
    bool operator==(const FrequencyRemap&) const = default;
};

/// From the collision to the event that is rendered, listed and told as played. Any thread.
struct EventShaping {
    RenderingMethod method;
    FrequencyRemap remap;
    double gain = 1.0; ///< of all events, also of a fixed level
    PerceivedLevel perceived{}; ///< at the frequency that is played, of what the gain made

    CollisionEvent operator()(const CollisionEvent& collision) const noexcept {
        CollisionEvent event = method(collision);
        event.frequencyHz = remap(event.frequencyHz);
        event.amplitude = perceived(event.amplitude * gain, event.frequencyHz);
        return event;
    }
    bool operator==(const EventShaping&) const = default;
};

} // namespace physvib
