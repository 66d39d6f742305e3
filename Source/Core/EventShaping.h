// SPDX-License-Identifier: MIT
// Stages between a collision and the rendered event: the rendering method of the thesis, then the mapping of
// frequencies into the actuators' band, then the level.
#pragma once
#include "Core/Actuators/PerceivedLevel.h"
#include "Core/Actuators/Resonator.h"
#include "Core/FixedLevel.h"
#include "Core/RenderingMethod.h"
#include "Core/SoundNumber.h"
#include <algorithm>
#include <cmath>

namespace physvib {

/// Maps the tactile frequency range into an actuator's band and keeps the order: equal musical intervals stay
/// equal, but become smaller. Live and offline rendering use the same mapping. Any thread.
struct FrequencyRemap {
    /// mapped to the band's ends; frequencies outside are clamped
    static constexpr double feltLowHz = 20.0, feltHighHz = 1000.0;
    FrequencyBand band; ///< not known: frequencies stay unchanged

    double operator()(double frequencyHz) const noexcept {
        if (!band.isKnown()) return frequencyHz;
        const double place = std::log(frequencyHz / feltLowHz) / std::log(feltHighHz / feltLowHz);
        return band.lowHz * std::pow(band.highHz / band.lowHz, std::clamp(place, 0.0, 1.0));
    }
    bool operator==(const FrequencyRemap&) const = default;
};

/// Turns a collision into the event that is rendered, listed and reported as played. Clips stay unchanged.
/// Any thread.
struct EventShaping {
    static constexpr double mostTruncation = 0.99;
    RenderingMethod method;
    FrequencyRemap remap;
    double gain = 1.0;          ///< of all events, also those of a fixed level
    PerceivedLevel perceived{}; ///< equal-sensation correction at the played frequency, after the gain
    double truncation = 0.0; ///< Eq. 5.5: a decay is cut where its envelope falls to this share; 0: it decays
                             ///< fully

    CollisionEvent operator()(const CollisionEvent& collision) const noexcept {
        return shaped(collision, [](CollisionEvent&) {});
    }

    /// The same; `hold` may change the event before the gain, when it has its played frequency.
    template <class Hold>
    CollisionEvent shaped(const CollisionEvent& collision, Hold hold) const noexcept {
        if (isClip(collision.sound)) return collision;
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
        if (!(seconds < 1e9)) return; // hardly decays: no cut
        const auto life = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(seconds * 1e9)) -
                                                        event.course.sinceNs);
        event.durationNs = event.durationNs > 0 ? std::min(event.durationNs, life) : life;
    }
};

/// The same for all impacts of one world, in time order. Stateful, because a held fixed level depends on
/// earlier impacts. One thread at a time.
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
