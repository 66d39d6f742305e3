// SPDX-License-Identifier: MIT
// Implementation of the .haptic reader and writer: version, metadata, signals.continuous.envelopes.
#include "Formats/ClipFile.h"
#include "Formats/EnvelopeFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

double readTime(const JsonField& point, double last) {
    const double seconds = point["time"].numberUpTo(limits::maxClipSeconds);
    if (seconds < last) point["time"].fail("expected times in order");
    return seconds;
}

/// Since `start`. Before its first point, or without points, a device plays the middle of its band.
std::vector<ClipPoint> frequencyCurve(const JsonField& envelopes, double start, const FrequencyScale& scale) {
    std::vector<ClipPoint> curve{{0.0, scale.toHz(0.5)}};
    if (!envelopes.has("frequency") || envelopes["frequency"].isNull()) return curve;
    const JsonField list = envelopes["frequency"];
    double last = 0.0;
    for (std::size_t i = 0; i < list.arraySize(); ++i) {
        const JsonField point = list.item(i);
        last = readTime(point, last);
        if (i == 0) curve.push_back({last, curve.back().value}); // the step before the first point
        curve.push_back({last, scale.toHz(point["frequency"].numberUpTo(1.0))});
    }
    std::vector<ClipPoint> sinceStart{{0.0, valueAt(curve, start)}};
    for (const ClipPoint& p : curve)
        if (p.seconds > start) sinceStart.push_back({p.seconds - start, p.value});
    return sinceStart;
}

Clip readClip(const JsonField& root, const FrequencyScale& scale) {
    root.expectObject();
    if (const JsonField major = root["version"]["major"]; major.wholeNumber() != 1)
        major.fail("expected version 1");
    Clip clip{root.has("metadata") && root["metadata"].has("description")
                  ? root["metadata"]["description"].line()
                  : "",
              0.0,
              0.0,
              {{}}};
    const JsonField envelopes = root["signals"]["continuous"]["envelopes"];
    const JsonField amplitudes = envelopes["amplitude"];
    if (amplitudes.arraySize() < 2)
        amplitudes.fail("expected at least two points, found " + std::to_string(amplitudes.arraySize()));
    ClipWave wave{
        amplitudes.item(0)["time"].numberUpTo(limits::maxClipSeconds), 0.0, ClipWaveform::sine, {}, {}};
    double last = 0.0;
    for (std::size_t i = 0; i < amplitudes.arraySize(); ++i) {
        const JsonField point = amplitudes.item(i);
        last = readTime(point, last);
        wave.amplitude.push_back({last - wave.startSeconds, point["amplitude"].numberUpTo(1.0)});
        if (!point.has("emphasis") || point["emphasis"].isNull()) continue;
        const JsonField emphasis = point["emphasis"];
        const double strength = emphasis["amplitude"].numberUpTo(1.0);
        if (strength < wave.amplitude.back().value)
            emphasis["amplitude"].fail("expected at least the envelope's amplitude");
        clip.channels[0].transients.push_back(
            {last, strength, scale.toHz(emphasis["frequency"].numberUpTo(1.0))});
    }
    if (!(wave.seconds() > 0.0)) amplitudes.fail("expected an envelope that lasts");
    wave.frequencyHz = frequencyCurve(envelopes, wave.startSeconds, scale);
    clip.channels[0].bands.push_back({{std::move(wave)}});
    if (auto error = clipError(clip); !error.empty()) envelopes.fail(error);
    return clip;
}

std::vector<ClipPoint> amplitudeCurve(const std::vector<EnvelopePoint>& envelope) {
    std::vector<ClipPoint> curve;
    for (const EnvelopePoint& p : envelope) curve.push_back({p.seconds, std::min(1.0, p.amplitude)});
    if (curve.empty()) curve = {{0.0, 0.0}};
    return curve;
}

constexpr double maxShiftSeconds = 0.0009; // maximum shift of a transient

/// The nearest time at which the envelope does not exceed the transient: its own, or a point nearby.
double shiftedSeconds(const ClipTransient& transient, const std::vector<ClipPoint>& curve) {
    const double at = transient.seconds;
    if (valueAt(curve, at) <= transient.amplitude) return at;
    double nearest = 2.0 * maxShiftSeconds;
    for (auto p = std::ranges::lower_bound(curve, at - maxShiftSeconds, {}, &ClipPoint::seconds);
         p != curve.end() && p->seconds <= at + maxShiftSeconds; ++p)
        if (p->value <= transient.amplitude && std::abs(p->seconds - at) < std::abs(nearest))
            nearest = p->seconds - at;
    return std::abs(nearest) <= maxShiftSeconds ? at + nearest : at;
}

/// In time order.
std::vector<ClipTransient> shiftedTransients(std::vector<ClipTransient> transients,
                                             const std::vector<ClipPoint>& curve) {
    for (ClipTransient& t : transients) t.seconds = shiftedSeconds(t, curve);
    sortByTime(transients, &ClipTransient::seconds);
    return transients;
}

/// The envelope with a point at each transient, and long enough for two distinct points.
std::vector<ClipPoint> withTransients(const std::vector<ClipPoint>& curve,
                                      const std::vector<ClipTransient>& transients) {
    std::vector<ClipPoint> result = curve;
    for (const ClipTransient& t : transients) result.push_back({t.seconds, valueAt(curve, t.seconds)});
    sortByTime(result, &ClipPoint::seconds);
    if (result.front().seconds > 0.0) result.insert(result.begin(), {0.0, 0.0});
    const double last = std::max(result.back().seconds, transients.empty() ? 0.0 : transients.back().seconds);
    if (!(roundedForFile(result.back().seconds) > 0.0) || !transients.empty())
        result.push_back({std::min(limits::maxClipSeconds, last + ClipTransient::durationSeconds), 0.0});
    return result;
}

OrderedJson amplitudesJson(const std::vector<ClipPoint>& curve, const std::vector<ClipTransient>& transients,
                           const FrequencyScale& scale) {
    OrderedJson list = OrderedJson::array();
    auto next = transients.begin();
    for (const ClipPoint& p : curve) {
        OrderedJson& point = list.emplace_back(
            OrderedJson{{"time", roundedForFile(p.seconds)}, {"amplitude", roundedForFile(p.value)}});
        if (next == transients.end() || next->seconds > p.seconds) continue;
        point["emphasis"] = {{"amplitude", roundedForFile(std::clamp(next->amplitude, p.value, 1.0))},
                             {"frequency", roundedForFile(scale.toShare(next->frequencyHz))}};
        ++next;
    }
    return list;
}

OrderedJson frequenciesJson(const std::vector<EnvelopePoint>& envelope, const FrequencyScale& scale) {
    constexpr double tolerance = 1e-3; // as a share of the scale
    std::vector<ClipPoint> curve;
    for (const EnvelopePoint& p : envelope) curve.push_back({p.seconds, scale.toShare(p.frequencyHz)});
    OrderedJson list = OrderedJson::array();
    for (const ClipPoint& p : simplifiedCurve(curve, tolerance))
        list.push_back({{"time", roundedForFile(p.seconds)}, {"frequency", roundedForFile(p.value)}});
    return list;
}

} // namespace

Result<Clip> readMetaHaptic(std::string_view text, std::string_view name, const FrequencyScale& scale) {
    return readJson(text, name, limits::maxClipFileBytes, [&](const Json& root) {
        return readClip({root, {}}, scale);
    });
}

std::size_t raisedTransientCount(const ClipChannel& channel) {
    const auto amplitudes = amplitudeCurve(makeEnvelope(channel));
    constexpr double unfelt = 0.01; // of full scale
    return static_cast<std::size_t>(
        std::ranges::count_if(shiftedTransients(channel.transients, amplitudes), [&](const ClipTransient& t) {
            return t.amplitude + unfelt < valueAt(amplitudes, t.seconds);
        }));
}

std::string metaHapticText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale) {
    const auto envelope = makeEnvelope(channel);
    const auto amplitudes = amplitudeCurve(envelope);
    const auto transients = shiftedTransients(channel.transients, amplitudes);
    OrderedJson envelopes{
        {"amplitude", amplitudesJson(withTransients(amplitudes, transients), transients, scale)}};
    if (auto frequencies = frequenciesJson(envelope, scale); !frequencies.empty())
        envelopes["frequency"] = std::move(frequencies);
    return prettyJson({{"version", {{"major", 1}, {"minor", 0}, {"patch", 0}}},
                       {"metadata",
                        {{"editor", "PhysVib"},
                         {"author", ""},
                         {"source", ""},
                         {"project", ""},
                         {"tags", OrderedJson::array()},
                         {"description", title}}},
                       {"signals", {{"continuous", {{"envelopes", std::move(envelopes)}}}}}});
}

} // namespace physvib
