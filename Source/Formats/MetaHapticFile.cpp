// SPDX-License-Identifier: MIT
// version, metadata, signals.continuous.envelopes.
#include "Formats/MetaHapticFile.h"
#include "Files/Json/JsonField.h"
#include "Files/Json/JsonFile.h"
#include "Files/Json/JsonLines.h"
#include "Formats/ClipEnvelope.h"
#include "Formats/ClipLimits.h"
#include <cmath>

namespace physvib {
namespace {

double timeOf(const JsonField& point, double last) {
    const double seconds = point["time"].numberUpTo(limits::maxClipSeconds);
    if (seconds < last) point["time"].fail("expected times in order");
    return seconds;
}

Clip readClip(const JsonField& root, const FrequencyScale& scale) {
    root.expectObject();
    if (const JsonField version = root["version"]; version["major"].wholeNumber() != 1) version["major"].fail("expected version 1");
    Clip clip{root.has("metadata") && root["metadata"].has("description") ? root["metadata"]["description"].line() : "", 0.0, 0.0, {{}}};
    const JsonField envelopes = root["signals"]["continuous"]["envelopes"];
    const JsonField amplitudes = envelopes["amplitude"];
    if (amplitudes.arraySize() < 2) amplitudes.fail("expected at least two points, found " + std::to_string(amplitudes.arraySize()));
    ClipWave wave{amplitudes.item(0)["time"].numberUpTo(limits::maxClipSeconds), 0.0, ClipWaveform::sine, {}, {}};
    double last = 0.0;
    for (std::size_t i = 0; i < amplitudes.arraySize(); ++i) {
        const JsonField point = amplitudes.item(i);
        last = timeOf(point, last);
        wave.amplitude.push_back({last - wave.startSeconds, point["amplitude"].numberUpTo(1.0)});
        if (!point.has("emphasis") || point["emphasis"].isNull()) continue;
        const JsonField emphasis = point["emphasis"];
        const double strength = emphasis["amplitude"].numberUpTo(1.0);
        if (strength < wave.amplitude.back().value) emphasis["amplitude"].fail("expected at least the envelope's amplitude");
        clip.channels[0].transients.push_back({last, strength, scale.hertz(emphasis["frequency"].numberUpTo(1.0))});
    }
    if (!(wave.seconds() > 0.0)) amplitudes.fail("expected an envelope that lasts");
    last = 0.0;
    if (envelopes.has("frequency") && !envelopes["frequency"].isNull())
        for (std::size_t i = 0; i < envelopes["frequency"].arraySize(); ++i) {
            const JsonField point = envelopes["frequency"].item(i);
            last = timeOf(point, last);
            wave.frequencyHz.push_back({std::max(0.0, last - wave.startSeconds), scale.hertz(point["frequency"].numberUpTo(1.0))});
        }
    if (wave.frequencyHz.empty()) wave.frequencyHz.push_back({0.0, scale.hertz(0.0)});
    clip.channels[0].bands.push_back({{std::move(wave)}});
    if (auto fault = clipFault(clip); !fault.empty()) envelopes.fail(fault);
    return clip;
}

/// The envelope with a point at each transient, and time enough for two.
std::vector<ClipPoint> amplitudesOf(const std::vector<EnvelopePoint>& envelope, const std::vector<ClipTransient>& transients) {
    std::vector<ClipPoint> curve;
    for (const EnvelopePoint& p : envelope) curve.push_back({p.seconds, std::min(1.0, p.amplitude)});
    if (curve.empty()) curve = {{0.0, 0.0}};
    std::vector<ClipPoint> with = curve;
    for (const ClipTransient& t : transients) with.push_back({t.seconds, valueAt(curve, t.seconds)});
    std::ranges::stable_sort(with, {}, &ClipPoint::seconds);
    if (with.front().seconds > 0.0) with.insert(with.begin(), {0.0, 0.0});
    if (with.size() < 2 || !transients.empty()) with.push_back({std::max(with.back().seconds, transients.empty() ? 0.0 : transients.back().seconds) + ClipTransient::lastsSeconds, 0.0});
    return with;
}

OrderedJson amplitudesJson(const std::vector<ClipPoint>& curve, const std::vector<ClipTransient>& transients, const FrequencyScale& scale) {
    OrderedJson list = OrderedJson::array();
    auto next = transients.begin();
    for (const ClipPoint& p : curve) {
        OrderedJson& point = list.emplace_back(OrderedJson{{"time", shortened(p.seconds)}, {"amplitude", shortened(p.value)}});
        if (next == transients.end() || next->seconds > p.seconds) continue;
        point["emphasis"] = {{"amplitude", shortened(std::clamp(next->amplitude, p.value, 1.0))}, {"frequency", shortened(scale.share(next->frequencyHz))}};
        while (next != transients.end() && next->seconds <= p.seconds) ++next;
    }
    return list;
}

OrderedJson frequenciesJson(const std::vector<EnvelopePoint>& envelope, const FrequencyScale& scale) {
    constexpr double tolerance = 1e-3; // of the scale
    std::vector<ClipPoint> curve;
    for (const EnvelopePoint& p : envelope) curve.push_back({p.seconds, scale.share(p.frequencyHz)});
    OrderedJson list = OrderedJson::array();
    for (const ClipPoint& p : thinned(curve, tolerance)) list.push_back({{"time", shortened(p.seconds)}, {"frequency", shortened(p.value)}});
    return list;
}

} // namespace

Result<Clip> readMetaHaptic(std::string_view text, std::string_view name, const FrequencyScale& scale) {
    return readJson(text, name, limits::maxClipFileBytes, [&](const Json& root) { return readClip({root, {}}, scale); });
}

std::string metaHapticText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale) {
    const auto envelope = envelopeOf(channel);
    const auto amplitudes = amplitudesOf(envelope, channel.transients);
    OrderedJson envelopes{{"amplitude", amplitudesJson(amplitudes, channel.transients, scale)}};
    if (auto frequencies = frequenciesJson(envelope, scale); !frequencies.empty()) envelopes["frequency"] = std::move(frequencies);
    return jsonLines({{"version", {{"major", 1}, {"minor", 0}, {"patch", 0}}},
                      {"metadata", {{"editor", "PhysVib"}, {"author", ""}, {"source", ""}, {"project", ""}, {"tags", OrderedJson::array()}, {"description", title}}},
                      {"signals", {{"continuous", {{"envelopes", std::move(envelopes)}}}}}});
}

} // namespace physvib
