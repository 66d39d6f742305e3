// SPDX-License-Identifier: MIT
// Common representation of haptic files: channels of waves whose amplitude and frequency are piecewise
// linear. All file formats are converted to and from it.
#pragma once
#include "Core/EnchanterLayout.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

// Limits of imported haptic files, each with the reason for its value.
namespace physvib::limits {

constexpr std::size_t maxClipFileBytes = 24'000'000; // parsed JSON needs six times its bytes: 150 MB
constexpr std::size_t maxClipPoints = 500'000;       // 10,000 impacts on four actuators, a dozen points each
constexpr std::size_t maxClipEvents = maxClipPoints / 2; // each has at least two points
constexpr std::size_t maxClipBands = 4096; // of all channels: each may have a sounding wave at any time
constexpr double maxClipSeconds = 600.0;   // as for recordings, because a clip becomes samples
constexpr double maxClipSoundingSeconds = 7200.0; // the sum over all waves: a thousand seconds of
                                                  // waves take one second to render
constexpr double maxClipFrequencyHz = 10'000.0;   // in MPEG's schema
constexpr double maxClipAmplitude = 1000.0;       // a channel's gain times an amplitude within -1 to 1

constexpr double maxAhapEventSeconds = 30.0; // for Apple's continuous events

} // namespace physvib::limits

namespace physvib {

constexpr double sameMomentSeconds = 1e-9; ///< tolerance for times computed in different ways

/// Rounds to whole nanoseconds, so that times computed by different sums in a file are equal. Any thread.
inline double roundedToNs(double seconds) noexcept { return std::round(seconds * 1e9) / 1e9; }

/// A point of a piecewise linear curve.
struct ClipPoint {
    double seconds = 0.0;
    double value = 0.0;
    bool operator==(const ClipPoint&) const = default;
};

/// The curve's value: a line between points, held before and after them; 0 without points. Any thread.
inline double valueAt(std::span<const ClipPoint> curve, double seconds) noexcept {
    if (curve.empty()) return 0.0;
    const auto next = std::upper_bound(curve.begin(), curve.end(), seconds,
                                       [](double t, const ClipPoint& p) { return t < p.seconds; });
    if (next == curve.begin()) return curve.front().value;
    const ClipPoint& before = *(next - 1);
    if (next == curve.end()) return before.value;
    return before.value +
           (next->value - before.value) * (seconds - before.seconds) / (next->seconds - before.seconds);
}

enum class ClipWaveform { sine, square, triangle, sawtoothUp, sawtoothDown };

/// amplitude(t) waveform(phase + 2 pi integral of the frequency), t from `startSeconds` to the last point.
struct ClipWave {
    double startSeconds = 0.0;
    double phaseRadians = 0.0;
    ClipWaveform waveform = ClipWaveform::sine;
    std::vector<ClipPoint> amplitude;   ///< 1: full scale
    std::vector<ClipPoint> frequencyHz; ///< at least one
    bool operator==(const ClipWave&) const = default;

    double seconds() const noexcept { return amplitude.empty() ? 0.0 : amplitude.back().seconds; }
    double endSeconds() const noexcept { return startSeconds + seconds(); }
};

/// Consecutive waves: each ends before the next begins.
struct ClipBand {
    std::vector<ClipWave> waves;
    bool operator==(const ClipBand&) const = default;
};

/// A short pulse: a sine that falls to 0 within `durationSeconds`.
struct ClipTransient {
    static constexpr double durationSeconds = 0.022; ///< as in MPEG's encoder
    double seconds = 0.0;
    double amplitude = 0.0;
    double frequencyHz = 0.0;
    bool operator==(const ClipTransient&) const = default;

    ClipWave wave() const {
        return {seconds,
                0.0,
                ClipWaveform::sine,
                {{0.0, amplitude}, {durationSeconds, 0.0}},
                {{0.0, frequencyHz}}};
    }
};

/// Properties of the actuator that a channel was made for, if the format stores them; 0: not known.
struct ClipDevice {
    double lowHz = 0.0, highHz = 0.0, resonanceHz = 0.0, fullScaleG = 0.0;
    bool operator==(const ClipDevice&) const = default;
};

struct ClipChannel {
    std::string label;
    std::optional<ActuatorPlace> place; ///< on the clip's extent
    ClipDevice device{};
    std::vector<ClipBand> bands{};           ///< all sound at the same time
    std::vector<ClipTransient> transients{}; ///< in time order
    bool operator==(const ClipChannel& other) const {
        return label == other.label && place.has_value() == other.place.has_value() && bands == other.bands &&
               transients == other.transients;
    }
};

/// At most limits::maxActuators channels.
struct Clip {
    std::string title;
    double extentWidthMetres = 0.0, extentHeightMetres = 0.0; ///< 0: no channel has a place
    std::vector<ClipChannel> channels;
    std::string omissions{}; ///< one line: contents of the file that are not played; empty: none
    bool operator==(const Clip&) const = default;

    double seconds() const noexcept {
        double end = 0.0;
        for (const ClipChannel& channel : channels) {
            for (const ClipBand& band : channel.bands)
                if (!band.waves.empty()) end = std::max(end, band.waves.back().endSeconds());
            if (!channel.transients.empty())
                end = std::max(end, channel.transients.back().seconds + ClipTransient::durationSeconds);
        }
        return end;
    }
    std::size_t points() const noexcept {
        std::size_t count = 0;
        for (const ClipChannel& channel : channels) {
            count += channel.transients.size();
            for (const ClipBand& band : channel.bands)
                for (const ClipWave& wave : band.waves) count += wave.amplitude.size();
        }
        return count;
    }
};

/// Empty, or why the clip is refused: it exceeds limits, or is empty. Any thread.
std::string clipError(const Clip& clip);

/// The largest amplitude of any wave or transient. Any thread.
double peakAmplitude(const ClipChannel& channel) noexcept;

/// Sorts the waves and ends each where the next begins, as MPEG's decoder plays a band. Any thread.
void makeSequential(ClipBand& band);

/// Maps the relative frequencies (0 to 1) of phone formats to Hz: linear over the actuator's range, by
/// default the range that MPEG's encoder uses for sharpness. Any thread.
struct FrequencyScale {
    double lowHz = 65.0, highHz = 300.0;

    double toHz(double share) const noexcept {
        return lowHz + (highHz - lowHz) * std::clamp(share, 0.0, 1.0);
    }
    double toShare(double hz) const noexcept { return std::clamp((hz - lowHz) / (highHz - lowHz), 0.0, 1.0); }
};

/// Indices into `times`, earliest first. Any thread.
inline std::vector<std::size_t> timeOrder(std::span<const double> times) {
    std::vector<std::size_t> order(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto isEarlier = [&](std::size_t a, std::size_t b) { return times[a] < times[b]; };
    std::stable_sort(order.begin(), order.end(), isEarlier);
    return order;
}

/// Stable sort by time; timeOrder() sorts for all types, so that the compiled code is small. `timeOf`: a
/// member or function that gives a finite number. Any thread.
template <class T, class TimeOf>
void sortByTime(std::vector<T>& items, TimeOf timeOf) {
    std::vector<double> times;
    times.reserve(items.size());
    for (const T& item : items) times.push_back(static_cast<double>(std::invoke(timeOf, item)));
    if (std::is_sorted(times.begin(), times.end())) return;
    std::vector<T> sorted;
    sorted.reserve(items.size());
    for (const std::size_t i : timeOrder(times)) sorted.push_back(std::move(items[i]));
    items = std::move(sorted);
}

} // namespace physvib
