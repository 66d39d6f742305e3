// SPDX-License-Identifier: MIT
// Computes the events of the messages strike, pattern, phantom, path and clip.
#include "Core/ActuatorCells.h"
#include "Core/PortableMath.h"
#include "Core/Samples.h"
#include "Io/Text/NumberText.h"
#include "Live/Messages/MessageValues.h"
#include "Scene/EventColumns.h"
#include "Scene/PartNames.h"
#include "Stimuli/Stimulus.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

std::int64_t nanoseconds(double seconds) { return std::llround(seconds * 1e9); }

CollisionEvent toneOf(const MessageValues& values, const EnchanterPlace& at, double fromSeconds,
                      double toSeconds, Spread spread) {
    CollisionEvent tone;
    tone.timeNs = nanoseconds(fromSeconds);
    tone.durationNs = nanoseconds(toSeconds) - tone.timeNs;
    tone.frequencyHz = values.number("frequency_hz");
    tone.amplitude = values.number("level");
    tone.x = at.xMetres;
    tone.y = at.yMetres;
    tone.z = at.zMetres;
    tone.spread = spread;
    if (values.has("part")) tone.source.part = partOf(values.word("part"));
    return tone;
}

/// For a tone that begins at phase 0: moves its end to a zero crossing of the frequency that is played.
CollisionEvent softlyEnded(CollisionEvent tone, const EventShaping& shaping) {
    if (tone.durationNs > 0) tone.durationNs = softEndNs(shaping(tone).frequencyHz, tone.durationNs);
    return tone;
}

void takeMaterial(CollisionEvent& strike, const MessageValues& values,
                  const std::vector<Material>& materials) {
    const std::string name = values.word("material");
    const auto found = std::ranges::find(materials, name, &Material::name);
    if (found == materials.end() || !(found->frequencyHz > 0.0))
        values.fail("material", "expected a material of the scene that vibrates, found " + inQuotes(name));
    if (values.has("decay_per_s"))
        values.fail("decay_per_s", "expected it with frequency_hz; a material has its own");
    strike.sound = soundOfMaterial(name);
    strike.frequencyHz = found->frequencyHz;
    strike.decayPerSecond = found->decayPerSecond;
}

} // namespace

std::vector<CollisionEvent> strikeStrikes(const MessageValues& values, const std::vector<Material>& materials,
                                          const EventShaping& shaping) {
    values.expectOneOf({"material", "frequency_hz"});
    CollisionEvent strike = toneOf(values, values.place(), 0.0, values.number("seconds"), values.spread());
    strike.decayPerSecond = values.number("decay_per_s");
    if (values.has("material"))
        takeMaterial(strike, values, materials);
    else if (!values.has("frequency_hz"))
        values.fail("material", "expected a material, or frequency_hz");
    if (strike.decayPerSecond == 0.0 && strike.durationNs == 0)
        values.fail("seconds", "expected a length, or a decay: it would not end");
    if (isTooSlow(strike))
        values.fail(values.has("material") ? "material" : "frequency_hz", tooSlowFault(strike));
    return {softlyEnded(strike, shaping)};
}

std::vector<CollisionEvent> phantomStrikes(const MessageValues& values, const std::vector<Material>&,
                                           const EventShaping& shaping) {
    return {
        softlyEnded(toneOf(values, values.place(), 0.0, values.number("seconds"), values.spread()), shaping)};
}

namespace {

std::vector<CollisionEvent> pulses(const MessageValues& values, std::string_view name,
                                   const std::string& letters, double pulseSeconds,
                                   const EventShaping& shaping) {
    if (letters.empty() || letters.size() > messages::mostPulses)
        values.fail(name, "expected 1 to " + std::to_string(messages::mostPulses) + " letters, found " +
                              std::to_string(letters.size()));
    std::vector<CollisionEvent> all;
    double from = 0.0;
    for (const char letter : letters) {
        all.push_back(softlyEnded(
            toneOf(values, values.enchanter(name, letter), from, from + pulseSeconds, Spread::alone),
            shaping));
        from += pulseSeconds + values.number("gap_s");
    }
    return all;
}

} // namespace

std::vector<CollisionEvent> patternStrikes(const MessageValues& values, const std::vector<Material>&,
                                           const EventShaping& shaping) {
    values.expectOneOf({"pattern", "enchanters"});
    values.expectOneOf({"pattern", "pulse_s"});
    if (values.has("enchanters"))
        return pulses(values, "enchanters", values.word("enchanters"), values.number("pulse_s"), shaping);
    const std::string label = values.word("pattern");
    const auto pattern = parsePatternLabel(label);
    if (!pattern)
        values.fail("pattern",
                    "expected one like ABA-250 (one to three actuators, then milliseconds), found " +
                        inQuotes(label));
    return pulses(values, "pattern", label.substr(0, static_cast<std::size_t>(pattern->count)),
                  pattern->pulseSeconds, shaping);
}

namespace {

/// A path: places and the times at which they are reached, from 0 on or later.
struct Route {
    std::vector<EnchanterPlace> places;
    std::vector<double> times;

    double startSeconds() const { return times.front(); }
    double seconds() const { return times.back() - times.front(); }
    EnchanterPlace at(double time) const {
        const auto next = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
            std::ranges::upper_bound(times, time) - times.begin(), 1, std::ssize(times) - 1));
        const double share = std::clamp((time - times[next - 1]) / (times[next] - times[next - 1]), 0.0, 1.0);
        return sumOf(places[next - 1], vectorFrom(places[next - 1], places[next]), share);
    }
};

double distance(const EnchanterPlace& a, const EnchanterPlace& b) {
    // nested, so that a path in the plane keeps its length to the bit
    return portable::hypot(portable::hypot(b.xMetres - a.xMetres, b.yMetres - a.yMetres),
                           b.zMetres - a.zMetres);
}

/// Constant speed; of consecutive equal places only the first is used.
Route steadyRoute(const MessageValues& values) {
    Route route;
    for (const EnchanterPlace& place : values.places()) {
        const double way = route.places.empty() ? 0.0 : distance(route.places.back(), place);
        if (way == 0.0 && !route.places.empty()) continue;
        route.times.push_back(route.times.empty() ? 0.0 : route.times.back() + way);
        route.places.push_back(place);
    }
    if (route.places.size() < 2) values.fail("places", "expected places that are not all the same");
    const double seconds = values.has("speed_m_per_s") ? route.times.back() / values.number("speed_m_per_s")
                                                       : values.number("seconds");
    if (seconds > messages::mostSeconds)
        values.fail("speed_m_per_s", "expected a path of at most " + numberText(messages::mostSeconds) +
                                         " s, found " + numberText(seconds));
    const double scale = seconds / route.times.back();
    for (double& time : route.times) time *= scale;
    return route;
}

Route timedRoute(const MessageValues& values) {
    Route route{values.places(), values.numbers("times_s")};
    if (route.times.size() != route.places.size())
        values.fail("times_s", "expected " + std::to_string(route.places.size()) +
                                   " times, one per place, found " + std::to_string(route.times.size()));
    return route;
}

/// Ends the last segment at a zero crossing of the whole tone. Later segments are removed.
void endSoftly(std::vector<CollisionEvent>& segments, const EventShaping& shaping) {
    const auto& last = segments.back();
    const std::int64_t end = softEndNs(shaping(last).frequencyHz, last.course.sinceNs + last.durationNs);
    while (segments.back().course.sinceNs >= end)
        segments.pop_back(); // the first one begins at 0, so one remains
    segments.back().durationNs = end - segments.back().course.sinceNs;
}

/// One tone in segments: each continues the phase of the one before.
std::vector<CollisionEvent> movingTone(const MessageValues& values, const Route& route,
                                       const EventShaping& shaping) {
    std::vector<CollisionEvent> segments;
    for (std::size_t i = 0; i + 1 < route.places.size(); ++i) {
        CollisionEvent segment =
            toneOf(values, route.places[i], route.times[i], route.times[i + 1], values.spread());
        if (segment.durationNs == 0) continue; // shorter than a nanosecond
        segment.course.toX = route.places[i + 1].xMetres;
        segment.course.toY = route.places[i + 1].yMetres;
        segment.course.toZ = route.places[i + 1].zMetres;
        segment.course.travelNs = segment.durationNs;
        segment.course.sinceNs = segment.timeNs - nanoseconds(route.startSeconds());
        segments.push_back(segment);
    }
    if (!segments.empty()) endSoftly(segments, shaping);
    return segments;
}

/// Overlapping stationary vibrations in phase: one tone that is at another place each time. Each begins and
/// ends at a zero crossing of the tone.
std::vector<CollisionEvent> strokesAlong(const MessageValues& values, const Route& route, int count,
                                         const EventShaping& shaping) {
    const double length = strokeSeconds(count, route.seconds());
    constexpr double least = 0.01; // two periods of 200 Hz
    if (length < least)
        values.fail("strokes", "expected so few that each lasts 0.01 s, found " + std::to_string(count) +
                                   " in " + numberText(route.seconds()) + " s");
    std::vector<CollisionEvent> strokes;
    for (int k = 0; k < count; ++k) {
        const double from = route.startSeconds() + k * strokeOnsetsSeconds(length);
        const EnchanterPlace at = route.at(route.startSeconds() + route.seconds() * k / (count - 1));
        strokes.push_back(toneOf(values, at, from, from + length, values.spread()));
        CollisionEvent& stroke = strokes.back();
        const std::int64_t begin = strokes.front().timeNs;
        const double playedHz = shaping(stroke).frequencyHz;
        stroke.course.sinceNs = nearestCrossingNs(playedHz, stroke.timeNs - begin);
        stroke.durationNs =
            softEndNs(playedHz, stroke.timeNs + stroke.durationNs - begin - stroke.course.sinceNs);
        stroke.timeNs = begin + stroke.course.sinceNs;
    }
    return strokes;
}

} // namespace

std::vector<CollisionEvent> pathStrikes(const MessageValues& values, const std::vector<Material>&,
                                        const EventShaping& shaping) {
    values.expectOneOf({"seconds", "speed_m_per_s", "times_s"});
    const Route route = values.has("times_s") ? timedRoute(values) : steadyRoute(values);
    const int strokes = values.wholeNumber("strokes");
    if (strokes == 1) values.fail("strokes", "expected 0, or 2 and more, found 1");
    return strokes == 0 ? movingTone(values, route, shaping) : strokesAlong(values, route, strokes, shaping);
}

namespace {

EnchanterPlace placeOfChannel(std::size_t j, const MessageValues& values, const LoadedClip& clip,
                              const PhantomPanner& panner) {
    if (values.has("place")) return values.place();
    if (!clip.shares.empty())
        return {clip.shares[j].xMetres * panner.fieldWidthMetres(),
                clip.shares[j].yMetres * panner.fieldHeightMetres()};
    const EnchanterLayout& layout = panner.layout();
    if (clip.channels.size() == 1) return values.place();
    if (static_cast<int>(clip.channels.size()) != layout.count)
        values.fail("file", "expected one channel, places, or as many channels as actuators, " +
                                std::to_string(layout.count) + ", found " +
                                std::to_string(clip.channels.size()));
    const EnchanterPlace& at = layout.places[j];
    const double wide = panner.fieldWidthMetres(), high = panner.fieldHeightMetres();
    return {at.xMetres / layout.extentWidthMetres * wide, at.yMetres / layout.extentHeightMetres * high,
            at.zMetres / layout.extentWidthMetres * wide};
}

} // namespace

std::vector<CollisionEvent> clipStrikes(const MessageValues& values, const LoadedClip& clip,
                                        const PhantomPanner& panner) {
    std::vector<CollisionEvent> strikes;
    for (std::size_t j = 0; j < clip.channels.size(); ++j) {
        const EnchanterPlace at = placeOfChannel(j, values, clip, panner);
        const ContactRecording& channel = clip.channels[j];
        CollisionEvent& strike = strikes.emplace_back();
        strike.frequencyHz = clipFrequencyHz;
        strike.amplitude = values.number("level");
        strike.x = at.xMetres;
        strike.y = at.yMetres;
        strike.z = at.zMetres;
        // so that the last sample is included
        strike.durationNs =
            nanoseconds(static_cast<double>(channel.samples.size()) / channel.sampleRateHz) + 1;
        strike.spread = values.spread();
    }
    return strikes;
}

} // namespace physvib
