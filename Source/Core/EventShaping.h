// SPDX-License-Identifier: MIT
// What becomes of a collision before it is rendered: the method, then the frequencies that the actuators can
// play, then the level.
#pragma once
#include "Core/Actuators/PerceivedLevel.h"
#include "Core/Actuators/Resonator.h"
#include "Core/ClipNumber.h"
#include "Core/FixedLevel.h"
#include "Core/RenderingMethod.h"
#include <algorithm>
#include <cmath>

namespace physvib {

/// Moves what is felt into a band, in its order: frequencies a musical interval apart stay an interval apart,
/// only a smaller one. The same for every list of events, so that live and offline agree. Any thread.
struct FrequencyRemap {
    /// go to the band's ends; what lies beyond, too
    static constexpr double feltLowHz = 20.0, feltHighHz = 1000.0;
    FrequencyBand band; ///< not known: nothing is moved

    double operator()(double frequencyHz) const noexcept {
        if (!band.isKnown()) return frequencyHz;
        const double place = std::log(frequencyHz / feltLowHz) / std::log(feltHighHz / feltLowHz);
        return band.lowHz * std::pow(band.highHz / band.lowHz, std::clamp(place, 0.0, 1.0));
    }
    bool operator==(const FrequencyRemap&) const = default;
};

/// From the collision to the event that is rendered, listed and told as played; a clip stays as it is. Any
/// thread.
struct EventShaping {
    static constexpr double mostTruncation = 0.99;
    RenderingMethod method;
    FrequencyRemap remap;
    double gain = 1.0;          ///< of all events, also of a fixed level
    PerceivedLevel perceived{}; ///< at the frequency that is played, of what the gain made
    double truncation = 0.0; ///< Eq. 5.5: a decay is cut where its envelope falls to this share; 0: it rings
                             ///< out

    CollisionEvent operator()(const CollisionEvent& collision) const noexcept {
        return shaped(collision, [](CollisionEvent&) {});
    }

    /// The same; what has the frequency that is played may be changed by `hold`, before the gain.
    template <class Hold>
    CollisionEvent shaped(const CollisionEvent& collision, Hold hold) const noexcept {
        if (isClip(collision.frequencyHz)) return collision;
        CollisionEvent event = method(collision);
        event.frequencyHz = remap(event.frequencyHz);
        hold(event);
        event.amplitude = perceived(event.amplitude * gain, event.frequencyHz);
        if (truncation > 0.0 && event.decayPerSecond > 0.0) cut(event);
        return event;
    }
    bool operator==(const EventShaping&) const = default;

private:
    void cut(CollisionEvent& event) const noexcept {
        const double seconds = -std::log(truncation) / event.decayPerSecond;
        if (!(seconds < 1e9)) return; // it hardly decays
        const auto life = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(seconds * 1e9)) -
                                                        event.course.sinceNs);
        event.durationNs = event.durationNs > 0 ? std::min(event.durationNs, life) : life;
    }
};

/// The same of all hits of a world, in time order: a fixed level that is held depends on those before. One
/// thread at a time.
class EventShaper {
public:
    explicit EventShaper(const EventShaping& shaping)
        : shaping_{shaping} {}
    CollisionEvent operator()(const CollisionEvent& collision) noexcept {
        return shaping_.shaped(collision,
                               [this](CollisionEvent& event) { event = level_(event, shaping_.method); });
    }
    void forget() noexcept { level_.forget(); }

private:
    EventShaping shaping_;
    FixedLevel level_;
};

} // namespace physvib
