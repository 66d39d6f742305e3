// SPDX-License-Identifier: MIT
// Converts the events of an .ahap file to a clip: each event with the control curves that apply during it,
// sampled where the curves bend.
#include "Formats/AhapPattern.h"
#include "Formats/ClipLimits.h"
#include "Formats/TimeOrder.h"
#include "Io/Json/StrictJson.h"
#include <cmath>

namespace physvib {
namespace {

constexpr double longestLine = 0.1; // of intensity: its square then deviates from its chord by at most 0.0025

/// The times at which `curve` bends during the event, including both ends.
std::vector<double> bends(const AhapEvent& event, const std::vector<ClipPoint>& curve) {
    const double end = momentOf(event.start + event.seconds);
    std::vector<double> at{event.start};
    const auto first = std::ranges::upper_bound(curve, event.start, {}, &ClipPoint::seconds);
    for (auto p = first; p != curve.end() && p->seconds < end; ++p) at.push_back(p->seconds);
    at.push_back(end);
    return at;
}

/// Calls `take` for each line of `value` between bends of `curve`: from its value at one to its value just
/// before the next.
template <class Value, class Take>
void eachLine(const AhapEvent& event, const std::vector<ClipPoint>& curve, Value value, Take take) {
    const auto at = bends(event, curve);
    for (std::size_t i = 0; i + 1 < at.size(); ++i)
        take(ClipPoint{at[i] - event.start, value(at[i])},
             ClipPoint{at[i + 1] - event.start, value(std::nextafter(at[i + 1], 0.0))});
}

void put(std::vector<ClipBand>& bands, ClipWave wave) {
    const auto isFree = [&](const ClipBand& band) {
        return band.waves.back().endSeconds() <= wave.startSeconds + sameMomentSeconds;
    };
    auto band = std::ranges::find_if(bands, isFree);
    if (band == bands.end()) band = bands.insert(bands.end(), ClipBand{});
    if (bands.size() > limits::maxClipBands)
        throw JsonError("Pattern", "expected at most " + std::to_string(limits::maxClipBands) +
                                       " events at once, found more");
    band->waves.push_back(std::move(wave));
}

class Bender {
public:
    Bender(AhapPattern& pattern, const FrequencyScale& scale)
        : scale_{scale}
        , intensity_{pattern.intensity.curve()}
        , sharpness_{pattern.sharpness.curve()} {}

    ClipTransient transientOf(const AhapEvent& event) const {
        const double strength = strengthOf(event, event.start);
        return {event.start, strength * strength, hertzOf(event, event.start)};
    }

    ClipWave waveOf(const AhapEvent& event) {
        ClipWave wave{event.start, 0.0, ClipWaveform::sine, {}, {}};
        const auto strength = [&](double at) { return strengthOf(event, at); };
        eachLine(event, intensity_, strength, [&](const ClipPoint& from, const ClipPoint& to) {
            const int pieces =
                std::max(1, static_cast<int>(std::ceil(std::abs(to.value - from.value) / longestLine)));
            grow(static_cast<std::size_t>(pieces));
            wave.amplitude.push_back({from.seconds, from.value * from.value});
            for (int k = 1; k < pieces; ++k) {
                const double share = static_cast<double>(k) / pieces,
                             value = std::lerp(from.value, to.value, share);
                wave.amplitude.push_back({std::lerp(from.seconds, to.seconds, share), value * value});
            }
            wave.amplitude.push_back({to.seconds, to.value * to.value});
        });
        const auto hertz = [&](double at) { return hertzOf(event, at); };
        eachLine(event, sharpness_, hertz, [&](const ClipPoint& from, const ClipPoint& to) {
            grow(1);
            wave.frequencyHz.push_back(from);
            wave.frequencyHz.push_back(to);
        });
        return wave;
    }

private:
    double strengthOf(const AhapEvent& event, double at) const {
        return event.intensity * valueAt(intensity_, at);
    }
    double hertzOf(const AhapEvent& event, double at) const {
        return scale_.hertz(event.sharpness + valueAt(sharpness_, at));
    }

    /// Each event copies the curves that apply during it, so many events on long curves could exceed the
    /// file's size by far.
    void grow(std::size_t points) {
        made_ += points;
        if (made_ > 4 * limits::maxClipPoints)
            throw JsonError("Pattern", "expected fewer events at once on such long curves");
    }

    FrequencyScale scale_;
    std::vector<ClipPoint> intensity_, sharpness_;
    std::size_t made_ = 0;
};

} // namespace

Clip clipOf(AhapPattern pattern, const FrequencyScale& scale) {
    sortByTime(pattern.events, &AhapEvent::start);
    Bender bender{pattern, scale};
    Clip clip;
    ClipChannel& channel = clip.channels.emplace_back();
    for (const AhapEvent& event : pattern.events)
        if (event.seconds == 0.0)
            channel.transients.push_back(bender.transientOf(event));
        else
            put(channel.bands, bender.waveOf(event));
    return clip;
}

} // namespace physvib
