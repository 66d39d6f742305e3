// SPDX-License-Identifier: MIT
// Stages between a collision and the rendered event: the thesis' rendering method, the mapping of frequencies
// into the actuators' band, the level, and events that compensate the mean of hits.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/Actuators/GuardLaw.h"
#include "Core/CollisionEvent.h"
#include "Core/NameNumbers.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace physvib {

/// Weights amplitudes, which are accelerations, towards what feels as strong at 250 Hz. The detection
/// threshold as a displacement is flat to 40 Hz and falls by 12 dB per octave to its minimum at about 250 Hz
/// (Verrillo 1963, large contactors at the thenar, as reported by Gescheider and Verrillo; unverified against
/// the paper, and displacement is assumed). Above that it rises; it is taken as flat here, the smallest
/// possible rise. Acceleration is (2 pi f)^2 times displacement: as an acceleration the threshold rises by 12
/// dB per octave, is flat from 40 to 250 Hz, and rises again. Half of it, in dB, is compensated, at most by a
/// factor of 2. Any thread.
struct PerceivedLevel {
    static constexpr double flatLowHz = 40.0, flatHighHz = 250.0; ///< constant threshold in between
    static constexpr double maxWeight = 2.0;                      ///< from 500 Hz on; its inverse up to 20 Hz

    bool isWeighted = false; ///< false: amplitudes stay unchanged

    /// Weight of a frequency > 0: sqrt((f / 40)^2) below 40 Hz, 1, sqrt((f / 250)^2) above 250 Hz; 0.5 to 2.
    static constexpr double weight(double frequencyHz) noexcept {
        const double nearest = std::clamp(frequencyHz, flatLowHz, flatHighHz);
        return std::clamp(frequencyHz / nearest, 1.0 / maxWeight, maxWeight);
    }

    /// The weighted amplitude. It raises none above full scale, and none that is above already.
    double operator()(double amplitude, double frequencyHz) const noexcept {
        if (!isWeighted) return amplitude;
        const double bound = std::max(std::abs(amplitude), 1.0);
        return std::clamp(amplitude * weight(frequencyHz), -bound, bound);
    }
    bool operator==(const PerceivedLevel&) const = default;
};

/// Approximate detection threshold in g at a frequency, by the same curve: 0.1 um at 250 Hz (20 dB below 1
/// um) is 0.025 g. An assumption: people, places and contactors differ by 10 dB. Any thread.
constexpr double detectionThresholdG(double frequencyHz) noexcept {
    constexpr double lowestG = 0.025;
    const double share =
        frequencyHz / std::clamp(frequencyHz, PerceivedLevel::flatLowHz, PerceivedLevel::flatHighHz);
    return lowestG * share * share;
}

/// A{V,F}-F{V,F}-DR{V,F} (the eight renderings of the thesis' study 2, 5.3): amplitude, frequency and decay
/// are varied (from physics) or fixed. The call operator turns a collision into the event that is rendered;
/// AV-FV-DRV changes nothing. Any thread.
struct RenderingMethod {
    static constexpr double fixedLevelG = 1.5; ///< acceleration in g; over the full scale, an amplitude
    static constexpr double fixedFrequencyHz = 250.0;
    static constexpr std::int64_t fixedPulseNs = 20'000'000; ///< rectangular envelope: five periods of 250
                                                             ///< Hz; other frequencies are cut in mid-period

    bool fixesAmplitude = false;
    bool fixesFrequency = false;
    bool fixesDecay = false;
    double fixedAmplitude = fixedLevelG; ///< 1 = full scale of an actuator, as in an event
    bool holdsLevel = false; ///< true: fixedAmplitude is the peak of the summed vibration, not each impact's
                             ///< A of Eq. 5.1 (FixedLevel)

    constexpr CollisionEvent operator()(CollisionEvent event) const noexcept {
        if (fixesAmplitude) event.amplitude = fixedAmplitude;
        if (fixesFrequency) event.frequencyHz = fixedFrequencyHz;
        if (!fixesDecay) return event;
        event.decayPerSecond = 0.0;
        event.durationNs = fixedPulseNs;
        return event;
    }
    constexpr bool fixesNothing() const noexcept { return !fixesAmplitude && !fixesFrequency && !fixesDecay; }
    bool operator==(const RenderingMethod&) const = default;
};

/// Parses a name like "AF-FV-DRF"; false, and `method` unchanged, if there is no such method. Any thread.
constexpr bool parseRenderingMethod(std::string_view name, RenderingMethod& method) noexcept {
    constexpr std::string_view varied = "AV-FV-DRV";
    constexpr std::size_t choices[] = {1, 4, 8}; // where V or F stands
    bool fixes[3] = {};
    if (name.size() != varied.size()) return false;
    for (std::size_t i = 0, next = 0; i < varied.size(); ++i) {
        const bool isChoice = next < 3 && i == choices[next];
        if (isChoice) fixes[next++] = name[i] == 'F';
        if (name[i] != varied[i] && !(isChoice && name[i] == 'F')) return false;
    }
    method.fixesAmplitude = fixes[0];
    method.fixesFrequency = fixes[1];
    method.fixesDecay = fixes[2];
    return true;
}

/// The method's name. Any thread.
constexpr std::array<char, 9> nameOf(const RenderingMethod& method) noexcept {
    std::array<char, 9> name{'A', 'V', '-', 'F', 'V', '-', 'D', 'R', 'V'};
    if (method.fixesAmplitude) name[1] = 'F';
    if (method.fixesFrequency) name[4] = 'F';
    if (method.fixesDecay) name[8] = 'F';
    return name;
}

/// The largest value of sin(2 pi f t) exp(-tau t), a little before its first quarter period. Any thread.
inline double peakOfDecay(double frequencyHz, double decayPerSecond) noexcept {
    const double omega = 2.0 * std::numbers::pi * frequencyHz, phase = portable::atan2(omega, decayPerSecond);
    return portable::sin(phase) * portable::exp(-decayPerSecond * phase / omega);
}

/// Sets the amplitudes of one world's impacts, in time order. An impact from rest peaks at the fixed
/// amplitude. A later one adds only what the sounding ones leave free, so that the sum never exceeds the
/// level, on one actuator or on all. One thread at a time; never allocates.
class FixedLevel {
public:
    /// Events without a causing fixture or without a frequency stay unchanged.
    CollisionEvent operator()(CollisionEvent event, const RenderingMethod& method) noexcept {
        if (!method.holdsLevel || !method.fixesAmplitude || event.source.fixture < 0 ||
            !(event.frequencyHz > 0.0))
            return event;
        const double remaining = std::max(0.0, method.fixedAmplitude - soundingAt(event.timeNs));
        event.amplitude = remaining / peakOfDecay(event.frequencyHz, event.decayPerSecond);
        if (remaining > 0.0) add(event);
        return event;
    }
    void reset() noexcept { envelopes_ = {}; }

private:
    struct Envelope {
        double level = 0.0, decayPerSecond = 0.0;
        std::int64_t startNs = 0, untilNs = 0;

        double at(std::int64_t timeNs) const noexcept {
            return timeNs >= untilNs ? 0.0
                                     : level * portable::exp(-1e-9 * decayPerSecond *
                                                             static_cast<double>(timeNs - startNs));
        }
    };

    double soundingAt(std::int64_t timeNs) const noexcept {
        double sum = 0.0;
        for (const Envelope& e : envelopes_) sum += e.at(timeNs);
        return sum;
    }

    /// Uses the entry with the lowest level. There are more entries than materials that sound at once, so the
    /// replaced envelope has practically decayed.
    void add(const CollisionEvent& event) noexcept {
        const std::int64_t untilNs = event.durationNs > 0 ? event.timeNs + event.durationNs : INT64_MAX;
        const auto isSame = [&](const Envelope& e) {
            return e.untilNs == INT64_MAX && untilNs == INT64_MAX && e.decayPerSecond == event.decayPerSecond;
        };
        auto envelope = std::find_if(envelopes_.begin(), envelopes_.end(), isSame);
        if (envelope == envelopes_.end())
            envelope = std::min_element(envelopes_.begin(), envelopes_.end(),
                                        [&](const Envelope& a, const Envelope& b) {
                                            return a.at(event.timeNs) < b.at(event.timeNs);
                                        });
        // The level of the replaced envelope is kept, though its decay then differs.
        const double remaining = envelope->at(event.timeNs);
        *envelope = {remaining + event.amplitude, event.decayPerSecond, event.timeNs, untilNs};
    }

    std::array<Envelope, 16> envelopes_{};
};

/// Maps the tactile frequency range into an actuator's band and keeps the order: equal musical intervals stay
/// equal, but become smaller. Live and offline rendering use the same mapping. Any thread.
struct FrequencyRemap {
    /// mapped to the band's ends; frequencies outside are clamped
    static constexpr double tactileLowHz = 20.0, tactileHighHz = 1000.0;
    FrequencyBand band; ///< not known: frequencies stay unchanged

    double operator()(double frequencyHz) const noexcept {
        if (!band.isKnown()) return frequencyHz;
        const double position =
            portable::log(frequencyHz / tactileLowHz) / portable::log(tactileHighHz / tactileLowHz);
        return band.lowHz * portable::pow(band.highHz / band.lowHz, std::clamp(position, 0.0, 1.0));
    }
    bool operator==(const FrequencyRemap&) const = default;
};

/// Turns a collision into the event that is rendered, listed and reported. Clips stay unchanged. Any thread.
struct EventShaping {
    static constexpr double maxTruncation = 0.99;
    RenderingMethod method;
    FrequencyRemap remap;
    double gain = 1.0;          ///< of all events, also those of a fixed level
    PerceivedLevel perceived{}; ///< equal-sensation correction at the played frequency, after the gain
    double truncation = 0.0;    ///< Eq. 5.5: decays are cut where they fall to this share; 0: not at all

    CollisionEvent operator()(const CollisionEvent& collision) const noexcept {
        return shaped(collision, [](CollisionEvent&) {});
    }

    /// The shaped event; `adjust` may change it before the gain, when it has its played frequency.
    template <class Adjust>
    CollisionEvent shaped(const CollisionEvent& collision, Adjust adjust) const noexcept {
        if (isClip(collision.sound)) return collision;
        CollisionEvent event = method(collision);
        event.frequencyHz = remap(event.frequencyHz);
        adjust(event);
        event.amplitude = perceived(event.amplitude * gain, event.frequencyHz);
        if (truncation > 0.0 && event.decayPerSecond > 0.0) truncate(event);
        return event;
    }
    bool operator==(const EventShaping&) const = default;

private:
    void truncate(CollisionEvent& event) const noexcept {
        const double seconds = -portable::log(truncation) / event.decayPerSecond;
        if (!(seconds < 1e9)) return; // hardly decays: no cut
        const auto lifeNs = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(seconds * 1e9)) -
                                                          event.course.toneAgeNs);
        event.durationNs = event.durationNs > 0 ? std::min(event.durationNs, lifeNs) : lifeNs;
    }
};

// A tone that ends in mid-period, or decays within a few periods, has a mean. The means of many hits add up
// to direct current, and the guard would turn down later hits (decision 54).

/// Integral of an event over its length, in seconds at full scale; `seconds`: until it ends. Any thread.
inline double areaOf(const CollisionEvent& e, double seconds) noexcept {
    const double omega = 2.0 * std::numbers::pi * e.frequencyHz, decay = e.decayPerSecond,
                 end = portable::cos(omega * seconds) * omega + portable::sin(omega * seconds) * decay;
    return e.amplitude * (omega - portable::exp(-decay * seconds) * end) / (omega * omega + decay * decay);
}

/// Whether the event is what meanCompensation() has added to a hit. Any thread.
inline bool isMeanCompensation(const CollisionEvent& e) noexcept {
    return e.amplitude < 0.0 && e.decayPerSecond == 0.0 &&
           std::abs(2e-9 * e.frequencyHz * static_cast<double>(e.durationNs) - 1.0) < 1e-6;
}

/// The event that compensates the mean of a hit: half a sine over the hit's length (of a decay: until a tenth
/// is left, at most 0.1 s), too slow to be felt. Its amplitude is 0 if the hit's mean is less than a tenth of
/// what the guard lets pass. Any thread.
inline CollisionEvent meanCompensation(CollisionEvent hit) noexcept {
    constexpr double maxSeconds = 0.5 / limits::slowestToneHz;
    const double decay = hit.decayPerSecond, lengthSeconds = hit.durationNs > 0
                                                                 ? 1e-9 * static_cast<double>(hit.durationNs)
                                                                 : std::numbers::ln10 / decay;
    const double area = areaOf(hit, lengthSeconds), seconds = std::min(lengthSeconds, maxSeconds);
    const bool isNegligible = isClip(hit.sound) || area <= 0.1 * limits::guardShare * limits::guardSeconds;
    hit.durationNs = std::llround(1e9 * seconds);
    hit.frequencyHz = 0.5e9 / static_cast<double>(hit.durationNs);
    hit.decayPerSecond = 0.0;
    hit.sound = 0;
    hit.amplitude = isNegligible ? 0.0 : -0.5 * std::numbers::pi * area / seconds;
    return hit;
}

/// Shapes all impacts of one world, in time order. Stateful, because a held fixed level depends on
/// earlier impacts. One thread at a time.
class EventShaper {
public:
    explicit EventShaper(const EventShaping& shaping)
        : shaping_{shaping} {}
    CollisionEvent operator()(const CollisionEvent& collision) noexcept {
        return shaping_.shaped(collision,
                               [this](CollisionEvent& event) { event = level_(event, shaping_.method); });
    }
    /// All from `first` on, in place. Where each hit has the fixed amplitude, its meanCompensation() follows
    /// it; events that no world produced get none, as when they are played live. A vector; allocates.
    template <class Events>
    void shape(Events& events, std::size_t first = 0) {
        const bool compensatesMeans = shaping_.method.fixesAmplitude && !shaping_.method.holdsLevel;
        for (std::size_t k = first; k < events.size(); ++k) events[k] = (*this)(events[k]);
        if (!compensatesMeans) return;
        Events shapedEvents;
        for (std::size_t k = 0; k < events.size(); ++k) {
            shapedEvents.push_back(events[k]);
            if (const CollisionEvent off = meanCompensation(events[k]);
                k >= first && events[k].source.fixture >= 0 && isMeanCompensation(off))
                shapedEvents.push_back(off);
        }
        events.swap(shapedEvents);
    }
    void reset() noexcept { level_.reset(); }

private:
    EventShaping shaping_;
    FixedLevel level_;
};

} // namespace physvib
