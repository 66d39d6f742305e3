// SPDX-License-Identifier: MIT
// Converts events to waves, and renders clips to samples. The starts and ends of a mode's waves are edges on
// ticks; between two edges the mode is one decaying sine.
#include "Formats/StrikeClip.h"
#include "Core/ClockLaw.h"
#include "Core/PortableMath.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

namespace physvib {
namespace {

constexpr int ticks = EventClipSettings::ticksPerSecond;
constexpr double silence = 1e-7; // 140 dB below full scale: the renderer, too, ends a mode there

using Phasor = std::complex<double>;

struct Mode {
    double frequencyHz, decayPerSecond;
    auto operator<=>(const Mode&) const = default;
    /// The factor by which a phasor changes in so many seconds.
    Phasor phasorFactor(double seconds) const {
        return portable::exp(Phasor{-decayPerSecond, 2.0 * std::numbers::pi * frequencyHz} * seconds);
    }
};

/// The phasor that is added to the mode at a tick.
struct Edge {
    std::int64_t tick;
    Phasor added;
};

void addEdges(std::vector<Edge>& edges, const Mode& mode, const CollisionEvent& event, double gain) {
    const FrameClock clock{ticks};
    const FramePosition onset = clock.at(event.timeNs);
    const double age = onset.leadFrames / ticks + static_cast<double>(event.course.toneAgeNs) * 1e-9;
    const Phasor initialPhasor = event.amplitude * gain * mode.phasorFactor(age);
    edges.push_back({onset.frame, initialPhasor});
    if (event.durationNs == 0) return;
    const std::int64_t close = clock.at(event.timeNs + event.durationNs).frame;
    edges.push_back(
        {close, -initialPhasor * mode.phasorFactor(static_cast<double>(close - onset.frame) / ticks)});
}

double positivePhase(Phasor phasor) {
    const double phase = portable::atan2(phasor.imag(), phasor.real());
    return phase < 0.0 ? phase + 2.0 * std::numbers::pi : phase;
}

std::vector<ClipWave> wavesOf(const Mode& mode, std::vector<Edge> edges, double error) {
    sortByTime(edges, &Edge::tick);
    std::vector<ClipWave> waves;
    Phasor ringing = 0.0;
    for (std::size_t i = 0; i < edges.size();) {
        const std::int64_t tick = edges[i].tick;
        for (; i < edges.size() && edges[i].tick == tick; ++i) ringing += edges[i].added;
        const bool isLast = i == edges.size();
        const std::int64_t length = isLast ? std::numeric_limits<std::int64_t>::max() : edges[i].tick - tick;
        if (portable::abs(ringing) > silence && !(isLast && mode.decayPerSecond == 0.0))
            waves.push_back({static_cast<double>(tick) / ticks,
                             positivePhase(ringing),
                             ClipWaveform::sine,
                             decayCurve(portable::abs(ringing), mode.decayPerSecond, length, error, ticks),
                             {{0.0, mode.frequencyHz}}});
        if (!isLast) ringing *= mode.phasorFactor(static_cast<double>(length) / ticks);
    }
    return waves;
}

struct ModeWave {
    std::size_t mode;
    ClipWave wave;
};

/// Uses as few bands as there are simultaneous waves. A mode stays in its band as long as possible: at the
/// tick where one of its waves ends, the next begins.
std::vector<ClipBand> packedBands(std::vector<ModeWave> waves, std::size_t modes) {
    sortByTime(waves, [](const ModeWave& w) { return w.wave.startSeconds; });
    std::vector<ClipBand> bands;
    std::vector<std::size_t> lastMode, bandOf(modes, waves.size());
    for (auto& [mode, wave] : waves) {
        if (bands.size() > limits::maxClipBands) break; // more than a clip may have
        std::size_t band = bandOf[mode];
        if (band >= bands.size() || lastMode[band] != mode)
            for (band = 0; band < bands.size() && bands[band].waves.back().endSeconds() >= wave.startSeconds;)
                ++band;
        if (band == bands.size()) bands.emplace_back(), lastMode.emplace_back();
        bands[band].waves.push_back(std::move(wave));
        lastMode[band] = mode;
        bandOf[mode] = band;
    }
    return bands;
}

/// The largest distance of exp(-s) from its chord over [0, u]; it lies where the slopes are equal.
double chordError(double u) {
    const double slope = -portable::expm1(-u) / u;
    return 1.0 - slope * (1.0 - portable::log(slope));
}

/// The longest u whose chord stays within `error`; the error grows with u.
double longestChord(double error) {
    double low = 0.0, high = 1.0;
    while (chordError(high) < error) high *= 2.0;
    for (int i = 0; i < 50; ++i) {
        const double middle = 0.5 * (low + high);
        (chordError(middle) < error ? low : high) = middle;
    }
    return low;
}

constexpr double finalChordErrors = 6.0; // in errors: from here on one last line to 0 stays within the error

} // namespace

Clip clipFromEvents(std::span<const CollisionEvent> events, const EventClipSettings& settings) {
    std::vector<std::map<Mode, std::vector<Edge>>> modes(settings.channels);
    PhantomPanner::Gains gains{};
    for (const CollisionEvent& event : events) {
        const Mode mode{event.frequencyHz, event.decayPerSecond};
        settings.gains(event, gains);
        for (std::size_t j = 0; j < settings.channels; ++j)
            if (gains[j] != 0.0) addEdges(modes[j][mode], mode, event, gains[j]);
    }
    Clip clip;
    clip.channels.resize(settings.channels);
    std::size_t points = 0;
    for (std::size_t j = 0; j < settings.channels; ++j) {
        std::vector<ModeWave> waves;
        std::size_t modeIndex = 0;
        for (auto& [mode, edges] : modes[j]) {
            for (ClipWave& wave : wavesOf(mode, std::move(edges), settings.error)) {
                points += wave.amplitude.size();
                waves.push_back({modeIndex, std::move(wave)});
            }
            ++modeIndex;
            if (points > limits::maxClipPoints) break; // more than a clip may have
        }
        clip.channels[j].bands = packedBands(std::move(waves), modeIndex);
    }
    return clip;
}

// Greedy: each chord is as long as its error allows, so chords become longer as the exponential falls.
std::vector<ClipPoint> decayCurve(double amplitude, double decayPerSecond, std::int64_t endTick, double error,
                                  int ticksPerSecond) {
    const auto at = [=](std::int64_t tick, double value) {
        return ClipPoint{static_cast<double>(tick) / ticksPerSecond, value};
    };
    std::vector<ClipPoint> curve{at(0, amplitude)};
    const double decayPerTick = decayPerSecond / ticksPerSecond;
    const auto toTicks = [=](double u) {
        return std::max<std::int64_t>(1, static_cast<std::int64_t>(std::min(u / decayPerTick, 9e15)));
    };
    for (std::int64_t tick = 0; tick < endTick;) {
        const double remainingShare = portable::exp(-decayPerTick * static_cast<double>(tick));
        if (decayPerTick > 0.0 && remainingShare <= finalChordErrors * error) {
            const std::int64_t last = tick + toTicks(portable::log(std::max(1.0, remainingShare / error)));
            if (last <= endTick) {
                curve.push_back(at(last, 0.0));
                return curve;
            }
        }
        tick = decayPerTick > 0.0
                   ? std::min(endTick, tick + toTicks(longestChord(std::min(error / remainingShare, 0.5))))
                   : endTick;
        curve.push_back(at(tick, amplitude * portable::exp(-decayPerTick * static_cast<double>(tick))));
    }
    return curve;
}

namespace {

/// A curve of at least one point and its integral, at times that increase: without repeated searches.
class CurveCursor {
public:
    explicit CurveCursor(std::span<const ClipPoint> curve)
        : curve_{curve} {}

    double value(double seconds) {
        advanceTo(seconds);
        if (next_ == 0) return curve_.front().value;
        const ClipPoint& from = curve_[next_ - 1];
        return next_ == curve_.size() ? from.value : from.value + slope() * (seconds - from.seconds);
    }
    /// The integral from 0 to `seconds`.
    double integral(double seconds) {
        advanceTo(seconds);
        if (next_ == 0) return curve_.front().value * seconds;
        const ClipPoint& from = curve_[next_ - 1];
        const double t = seconds - from.seconds;
        return integralBefore_ + t * (from.value + (next_ == curve_.size() ? 0.0 : 0.5 * slope() * t));
    }

private:
    void advanceTo(double seconds) {
        for (; next_ < curve_.size() && curve_[next_].seconds <= seconds; ++next_) {
            const ClipPoint& to = curve_[next_];
            integralBefore_ += next_ == 0 ? to.value * to.seconds
                                          : 0.5 * (curve_[next_ - 1].value + to.value) *
                                                (to.seconds - curve_[next_ - 1].seconds);
        }
    }
    double slope() const {
        const ClipPoint& from = curve_[next_ - 1];
        return (curve_[next_].value - from.value) / (curve_[next_].seconds - from.seconds);
    }

    std::span<const ClipPoint> curve_;
    std::size_t next_ = 0;        // first later point
    double integralBefore_ = 0.0; // integral up to the point before it
};

constexpr double frameTolerance = 1e-6; // a time that was a whole number of ticks gives that tick again

std::size_t firstFrameFrom(double seconds, int rateHz) {
    return static_cast<std::size_t>(std::ceil(std::max(0.0, seconds * rateHz - frameTolerance)));
}

/// Value of the waveform at a phase in cycles.
double waveformValue(ClipWaveform waveform, double cycles) {
    const double place = cycles - std::floor(cycles);
    switch (waveform) {
    case ClipWaveform::square: return place < 0.5 ? 1.0 : -1.0;
    case ClipWaveform::triangle: return 1.0 - 4.0 * std::abs(place < 0.75 ? place - 0.25 : place - 1.25);
    case ClipWaveform::sawtoothUp: return place < 0.5 ? 2.0 * place : 2.0 * place - 2.0;
    case ClipWaveform::sawtoothDown: return place < 0.5 ? -2.0 * place : 2.0 - 2.0 * place;
    default: return portable::sin(2.0 * std::numbers::pi * place);
    }
}

void add(const ClipWave& wave, int rateHz, std::vector<double>& out) {
    for (const ClipPoint& p : wave.frequencyHz)
        if (p.value >= 0.5 * rateHz) return;
    CurveCursor amplitude{wave.amplitude}, frequency{wave.frequencyHz};
    const double phase = wave.phaseRadians / (2.0 * std::numbers::pi);
    const std::size_t end = std::min(out.size(), firstFrameFrom(wave.endSeconds(), rateHz));
    for (std::size_t n = firstFrameFrom(wave.startSeconds, rateHz); n < end; ++n) {
        const double t = std::max(0.0, static_cast<double>(n) / rateHz - wave.startSeconds);
        out[n] += amplitude.value(t) * waveformValue(wave.waveform, phase + frequency.integral(t));
    }
}

} // namespace

SampledSound clipSound(const Clip& clip, int sampleRateHz) {
    SampledSound sound{sampleRateHz, {}};
    std::vector<double> sum(std::max<std::size_t>(1, firstFrameFrom(clip.seconds(), sampleRateHz)));
    for (const ClipChannel& channel : clip.channels) {
        std::ranges::fill(sum, 0.0);
        for (const ClipBand& band : channel.bands)
            for (const ClipWave& wave : band.waves) add(wave, sampleRateHz, sum);
        for (const ClipTransient& transient : channel.transients) add(transient.wave(), sampleRateHz, sum);
        sound.channels.emplace_back(sum.begin(), sum.end());
    }
    return sound;
}

} // namespace physvib
