// SPDX-License-Identifier: MIT
// Renders a clip wave by wave: interpolates amplitude and frequency; the phase is the integral of the
// frequency.
#include "Formats/ClipSound.h"
#include "Core/PortableMath.h"
#include "Formats/Clip.h"
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace physvib {
namespace {

/// A curve of at least one point and its integral, at times that increase: without repeated searches.
class CurveWalk {
public:
    explicit CurveWalk(std::span<const ClipPoint> curve)
        : curve_{curve} {}

    double value(double seconds) {
        goTo(seconds);
        if (next_ == 0) return curve_.front().value;
        const ClipPoint& from = curve_[next_ - 1];
        return next_ == curve_.size() ? from.value : from.value + slope() * (seconds - from.seconds);
    }
    /// From 0 to `seconds`.
    double integral(double seconds) {
        goTo(seconds);
        if (next_ == 0) return curve_.front().value * seconds;
        const ClipPoint& from = curve_[next_ - 1];
        const double t = seconds - from.seconds;
        return before_ + t * (from.value + (next_ == curve_.size() ? 0.0 : 0.5 * slope() * t));
    }

private:
    void goTo(double seconds) {
        for (; next_ < curve_.size() && curve_[next_].seconds <= seconds; ++next_) {
            const ClipPoint& to = curve_[next_];
            before_ += next_ == 0 ? to.value * to.seconds
                                  : 0.5 * (curve_[next_ - 1].value + to.value) *
                                        (to.seconds - curve_[next_ - 1].seconds);
        }
    }
    double slope() const {
        const ClipPoint& from = curve_[next_ - 1];
        return (curve_[next_].value - from.value) / (curve_[next_].seconds - from.seconds);
    }

    std::span<const ClipPoint> curve_;
    std::size_t next_ = 0; // first later point
    double before_ = 0.0;  // integral up to the point before it
};

constexpr double frameSlack = 1e-6; // a time that was a whole number of ticks gives that tick again

std::size_t frameFrom(double seconds, int rateHz) {
    return static_cast<std::size_t>(std::ceil(std::max(0.0, seconds * rateHz - frameSlack)));
}

/// Value of the waveform at a phase in cycles.
double shape(ClipWaveform waveform, double cycles) {
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
    CurveWalk amplitude{wave.amplitude}, frequency{wave.frequencyHz};
    const double phase = wave.phaseRadians / (2.0 * std::numbers::pi);
    const std::size_t end = std::min(out.size(), frameFrom(wave.endSeconds(), rateHz));
    for (std::size_t n = frameFrom(wave.startSeconds, rateHz); n < end; ++n) {
        const double t = std::max(0.0, static_cast<double>(n) / rateHz - wave.startSeconds);
        out[n] += amplitude.value(t) * shape(wave.waveform, phase + frequency.integral(t));
    }
}

} // namespace

SampledSound clipSound(const Clip& clip, int sampleRateHz) {
    SampledSound sound{sampleRateHz, {}};
    std::vector<double> sum(std::max<std::size_t>(1, frameFrom(clip.seconds(), sampleRateHz)));
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
