// SPDX-License-Identifier: MIT
// Lines through the envelope at whole milliseconds, each as long as it stays within a cone of slopes.
#include "Formats/EnvelopeFile.h"
#include "Formats/ClipEnvelope.h"
#include "Io/Json/JsonText.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr std::size_t maxPoints = 16; // that every phone takes
constexpr int maxMilliseconds = 1000; // likewise, of a point
constexpr double tolerance = 0.01, leastTolerance = 2e-4, toleranceHertz = 1.0;
constexpr double leastAmplitude = 5e-3; // below it an effect ends

/// The envelope at a whole millisecond.
struct Sample {
    double amplitude, hertz;
    bool isSilent() const { return amplitude < leastAmplitude; }
};

std::vector<Sample> sampled(const ClipChannel& channel, const FrequencyScale& scale) {
    ClipChannel whole = channel;
    for (const ClipTransient& transient : channel.transients) whole.bands.push_back({{transient.wave()}});
    const std::vector<EnvelopePoint> envelope = envelopeOf(whole);
    std::vector<Sample> samples;
    if (envelope.empty()) return samples;
    const int last = static_cast<int>(std::ceil(1e3 * envelope.back().seconds)) + 1;
    for (int ms = 0; ms <= last; ++ms) {
        const EnvelopePoint p = pointAt(envelope, 1e-3 * ms);
        samples.push_back({std::min(1.0, p.amplitude), std::clamp(p.frequencyHz, scale.lowHz, scale.highHz)});
    }
    return samples;
}

/// Slopes that stay within the tolerance of all values so far.
struct Cone {
    double least = -INFINITY, most = INFINITY;
    bool take(double rise, double run, double error) {
        const double low = std::max(least, (rise - error) / run), high = std::min(most, (rise + error) / run);
        if (low > high) return false;
        least = low, most = high;
        return true;
    }
    double nearest(double slope) const { return std::clamp(slope, least, most); }
};

/// The farthest end of a line from `a` at `from` that is within the tolerances of all samples.
std::size_t lineFrom(std::span<const Sample> samples, std::size_t from, const Sample& a, Sample& end) {
    Cone amplitudes, pitches;
    std::size_t last = from + 1;
    end = samples[last];
    for (std::size_t i = last; i < samples.size() && i - from <= maxMilliseconds; ++i) {
        const Sample& b = samples[i];
        const double run = static_cast<double>(i - from), rise = b.amplitude - a.amplitude,
                     turn = b.hertz - a.hertz;
        if (!amplitudes.take(rise, run, std::max(leastTolerance, tolerance * b.amplitude)) ||
            !pitches.take(turn, run, b.isSilent() ? INFINITY : toleranceHertz))
            break;
        last = i;
        end = {a.amplitude + run * amplitudes.nearest(rise / run),
               a.hertz + run * pitches.nearest(turn / run)};
        if (b.isSilent()) break;
    }
    return last;
}

} // namespace

std::vector<AndroidEffect> androidEffects(const ClipChannel& channel, const FrequencyScale& scale) {
    const std::vector<Sample> samples = sampled(channel, scale);
    std::vector<AndroidEffect> effects;
    bool isOpen = false; // the last effect goes on
    const auto begin = [&](std::size_t at) {
        effects.push_back({static_cast<int>(at), samples[at].hertz, {}});
        isOpen = true;
    };
    Sample now{}; // where the last line has ended
    for (std::size_t at = 0, end = 0; at + 1 < samples.size(); at = end) {
        end = at + 1;
        if (samples[at].isSilent() && samples[end].isSilent()) {
            isOpen = false;
            continue;
        }
        if (!isOpen || effects.back().points.size() == maxPoints) {
            begin(at);
            now = samples[end]; // from 0 within the first millisecond
        } else {
            end = lineFrom(samples, at, Sample{now}, now);
        }
        if (samples[end].isSilent()) now.amplitude = 0.0;
        effects.back().points.push_back(
            {std::clamp(now.amplitude, 0.0, 1.0), now.hertz, static_cast<int>(end - at)});
    }
    return effects;
}

std::string envelopeText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale) {
    OrderedJson effects = OrderedJson::array();
    const auto rounded = [](double value, double steps) { return std::round(value * steps) / steps; };
    for (const AndroidEffect& effect : androidEffects(channel, scale)) {
        OrderedJson points = OrderedJson::array();
        for (const AndroidPoint& p : effect.points)
            points.push_back({rounded(p.amplitude, 1e5), rounded(p.hertz, 10.0), p.milliseconds});
        effects.push_back({{"start_ms", effect.startMilliseconds},
                           {"initial_hz", rounded(effect.initialHertz, 10.0)},
                           {"points", std::move(points)}});
    }
    return jsonLines({{"android_waveform_envelope", 1},
                      {"title", title},
                      {"point", {"amplitude", "hz", "ms"}},
                      {"effects", std::move(effects)}});
}

} // namespace physvib
