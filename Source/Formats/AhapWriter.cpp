// SPDX-License-Identifier: MIT
// The envelope in stretches between silences: a continuous event of full intensity and no sharpness each, and two curves.
#include "Files/Json/JsonLines.h"
#include "Formats/AhapFile.h"
#include "Formats/ClipEnvelope.h"
#include <cmath>

namespace physvib {
namespace {

constexpr double longestEventSeconds = 30.0; // of Apple's continuous events
constexpr double silenceSeconds = 0.05;      // what lasts longer is no part of an event
constexpr double intensityTolerance = 0.002, sharpnessTolerance = 0.001;
constexpr double steepSeconds = 0.001;       // what rises or falls sooner is a step to a hand
constexpr int rootLines = 6; // of a line of amplitude: its root bends

OrderedJson parametersJson(double intensity, double sharpness) {
    return OrderedJson::array({{{"ParameterID", "HapticIntensity"}, {"ParameterValue", shortened(intensity)}}, {{"ParameterID", "HapticSharpness"}, {"ParameterValue", shortened(sharpness)}}});
}

OrderedJson curveJson(const char* parameter, double start, const std::vector<ClipPoint>& curve) {
    OrderedJson points = OrderedJson::array();
    for (const ClipPoint& p : curve) points.push_back({{"Time", shortened(p.seconds - start)}, {"ParameterValue", shortened(p.value)}});
    return {{"ParameterCurve", {{"ParameterID", parameter}, {"Time", shortened(start)}, {"ParameterCurveControlPoints", std::move(points)}}}};
}

/// Closer together where the amplitude is small, for there its root is steep.
std::vector<ClipPoint> intensitiesOf(std::span<const EnvelopePoint> envelope) {
    std::vector<ClipPoint> curve;
    for (std::size_t i = 0; i < envelope.size(); ++i) {
        const EnvelopePoint& p = envelope[i];
        const double intensity = std::sqrt(std::min(1.0, p.amplitude));
        const bool isLine = i > 0 && p.seconds - envelope[i - 1].seconds > steepSeconds;
        for (int k = 1; isLine && k < rootLines; ++k) { // even steps of intensity
            const EnvelopePoint& from = envelope[i - 1];
            const double root = std::sqrt(std::min(1.0, from.amplitude)), value = root + (intensity - root) * k / rootLines;
            if (p.amplitude != from.amplitude) curve.push_back({from.seconds + (p.seconds - from.seconds) * std::clamp((value * value - from.amplitude) / (p.amplitude - from.amplitude), 0.0, 1.0), value});
        }
        curve.push_back({p.seconds, intensity});
    }
    return thinned(curve, intensityTolerance);
}

void addStretch(OrderedJson& pattern, std::span<const EnvelopePoint> envelope, const FrequencyScale& scale) {
    const double start = envelope.front().seconds, seconds = envelope.back().seconds - start;
    if (!(seconds > 0.0)) return;
    std::vector<ClipPoint> sharpness;
    for (const EnvelopePoint& p : envelope) sharpness.push_back({p.seconds, scale.share(p.frequencyHz)});
    pattern.push_back({{"Event", {{"Time", shortened(start)}, {"EventType", "HapticContinuous"}, {"EventDuration", shortened(seconds)}, {"EventParameters", parametersJson(1.0, 0.0)}}}});
    pattern.push_back(curveJson("HapticIntensityControl", start, intensitiesOf(envelope)));
    pattern.push_back(curveJson("HapticSharpnessControl", start, thinned(sharpness, sharpnessTolerance)));
}

/// Ends of the stretch that begins at `from`: before a silence, or while it is short enough.
std::size_t stretchEnd(const std::vector<EnvelopePoint>& envelope, std::size_t from) {
    std::size_t to = from;
    while (to + 1 < envelope.size()) {
        const EnvelopePoint &a = envelope[to], &b = envelope[to + 1];
        if (a.amplitude == 0.0 && b.amplitude == 0.0 && b.seconds - a.seconds > silenceSeconds) break;
        if (to > from && b.seconds - envelope[from].seconds > longestEventSeconds) break;
        ++to;
    }
    return to;
}

/// A line that takes longer than an event may in pieces that an event takes.
std::vector<EnvelopePoint> cutToLength(const std::vector<EnvelopePoint>& envelope) {
    std::vector<EnvelopePoint> cut;
    for (const EnvelopePoint& p : envelope) {
        const EnvelopePoint from = cut.empty() ? p : cut.back();
        const int pieces = static_cast<int>(std::ceil((p.seconds - from.seconds) / (0.5 * longestEventSeconds)));
        for (int k = 1; k < pieces; ++k) {
            const double s = static_cast<double>(k) / pieces;
            cut.push_back({std::lerp(from.seconds, p.seconds, s), std::lerp(from.amplitude, p.amplitude, s), std::lerp(from.frequencyHz, p.frequencyHz, s)});
        }
        cut.push_back(p);
    }
    return cut;
}

} // namespace

std::string ahapText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale) {
    OrderedJson pattern = OrderedJson::array();
    const auto envelope = cutToLength(envelopeOf(channel));
    for (std::size_t from = 0; from + 1 < envelope.size();) {
        const std::size_t to = stretchEnd(envelope, from);
        if (to > from) addStretch(pattern, std::span{envelope}.subspan(from, to - from + 1), scale);
        const bool isSilent = to + 1 < envelope.size() && envelope[to].amplitude == 0.0 && envelope[to + 1].amplitude == 0.0;
        from = to > from && !isSilent ? to : to + 1;
    }
    for (const ClipTransient& t : channel.transients)
        pattern.push_back({{"Event", {{"Time", shortened(t.seconds)}, {"EventType", "HapticTransient"}, {"EventParameters", parametersJson(std::sqrt(std::clamp(t.amplitude, 0.0, 1.0)), scale.share(t.frequencyHz))}}}});
    return jsonLines({{"Version", 1}, {"Metadata", {{"Project", title}, {"Created", "PhysVib"}}}, {"Pattern", std::move(pattern)}});
}

} // namespace physvib
