// SPDX-License-Identifier: MIT
// Checks a message's values against the types and ranges of the table, resolves places and actuator letters,
// and computes the events of a message.
#include "Live/Messages/MessageValues.h"
#include "Core/ActuatorCells.h"
#include "Core/PortableMath.h"
#include "Core/Samples.h"
#include "Io/Text/NameList.h"
#include "Scene/EventColumns.h"
#include "Scene/PartNames.h"
#include "Stimuli/Stimulus.h"

namespace physvib {

namespace {

constexpr double maxPlaceMetres = 1e6; // beyond every field

bool isOnSomeField(double metres) { return std::abs(metres) <= maxPlaceMetres; }

std::int64_t toNs(double seconds) { return std::llround(seconds * 1e9); }

CollisionEvent makeTone(const MessageValues& values, const ActuatorPlace& place, double startSeconds,
                        double endSeconds, Spread spread) {
    CollisionEvent tone;
    tone.timeNs = toNs(startSeconds);
    tone.durationNs = toNs(endSeconds) - tone.timeNs;
    tone.frequencyHz = values.number("frequency_hz");
    tone.amplitude = values.number("level");
    tone.x = place.xMetres;
    tone.y = place.yMetres;
    tone.z = place.zMetres;
    tone.spread = spread;
    if (values.has("part")) tone.source.part = toPartNumber(values.text("part"));
    return tone;
}

/// For a tone that begins at phase 0: moves its end to a zero crossing of the frequency that is played.
CollisionEvent cutAtCrossing(CollisionEvent tone, const EventShaping& shaping) {
    if (tone.durationNs > 0) tone.durationNs = toneEndNs(shaping(tone).frequencyHz, tone.durationNs);
    return tone;
}

void applyMaterial(CollisionEvent& strike, const MessageValues& values,
                   const std::vector<Material>& materials) {
    const std::string name = values.text("material");
    const auto found = std::ranges::find(materials, name, &Material::name);
    if (found == materials.end() || !(found->frequencyHz > 0.0))
        values.fail("material", "expected a material of the scene that vibrates, found " + inQuotes(name));
    if (values.has("decay_per_s"))
        values.fail("decay_per_s", "expected it with frequency_hz; a material has its own");
    strike.sound = soundOfMaterial(name);
    strike.frequencyHz = found->frequencyHz;
    strike.decayPerSecond = found->decayPerSecond;
}

std::vector<CollisionEvent> makePulses(const MessageValues& values, std::string_view name,
                                       const std::string& letters, double pulseSeconds,
                                       const EventShaping& shaping) {
    if (letters.empty() || letters.size() > messages::maxPulses)
        values.fail(name, "expected 1 to " + std::to_string(messages::maxPulses) + " letters, found " +
                              std::to_string(letters.size()));
    std::vector<CollisionEvent> all;
    double start = 0.0;
    for (const char letter : letters) {
        all.push_back(cutAtCrossing(makeTone(values, values.actuatorPlace(name, letter), start,
                                             start + pulseSeconds, Spread::nearest),
                                    shaping));
        start += pulseSeconds + values.number("gap_s");
    }
    return all;
}

/// A path: places and the times at which they are reached, from 0 on or later.
struct Route {
    std::vector<ActuatorPlace> places;
    std::vector<double> times;

    double startSeconds() const { return times.front(); }
    double seconds() const { return times.back() - times.front(); }
    ActuatorPlace placeAt(double time) const {
        const auto next = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
            std::ranges::upper_bound(times, time) - times.begin(), 1, std::ssize(times) - 1));
        const double share = std::clamp((time - times[next - 1]) / (times[next] - times[next - 1]), 0.0, 1.0);
        return addScaled(places[next - 1], vectorBetween(places[next - 1], places[next]), share);
    }
};

double distance(const ActuatorPlace& a, const ActuatorPlace& b) {
    // nested, so that a path in the plane keeps its length to the bit
    return portable::hypot(portable::hypot(b.xMetres - a.xMetres, b.yMetres - a.yMetres),
                           b.zMetres - a.zMetres);
}

/// The path at constant speed; of consecutive equal places only the first is used.
Route steadyRoute(const MessageValues& values) {
    Route route;
    for (const ActuatorPlace& place : values.places()) {
        const double metres = route.places.empty() ? 0.0 : distance(route.places.back(), place);
        if (metres == 0.0 && !route.places.empty()) continue;
        route.times.push_back(route.times.empty() ? 0.0 : route.times.back() + metres);
        route.places.push_back(place);
    }
    if (route.places.size() < 2) values.fail("places", "expected places that are not all the same");
    const double seconds = values.has("speed_m_per_s") ? route.times.back() / values.number("speed_m_per_s")
                                                       : values.number("seconds");
    if (seconds > messages::maxSeconds)
        values.fail("speed_m_per_s", "expected a path of at most " + numberText(messages::maxSeconds) +
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
void cutLastSegment(std::vector<CollisionEvent>& segments, const EventShaping& shaping) {
    const auto& last = segments.back();
    const std::int64_t endNs = toneEndNs(shaping(last).frequencyHz, last.course.toneAgeNs + last.durationNs);
    while (segments.back().course.toneAgeNs >= endNs)
        segments.pop_back(); // the first one begins at 0, so one remains
    segments.back().durationNs = endNs - segments.back().course.toneAgeNs;
}

/// Events of one moving tone, a segment each, which continue each other's phase.
std::vector<CollisionEvent> makeMotion(const MessageValues& values, const Route& route,
                                       const EventShaping& shaping) {
    std::vector<CollisionEvent> segments;
    for (std::size_t i = 0; i + 1 < route.places.size(); ++i) {
        CollisionEvent segment =
            makeTone(values, route.places[i], route.times[i], route.times[i + 1], values.spread());
        if (segment.durationNs == 0) continue; // shorter than a nanosecond
        segment.course.toX = route.places[i + 1].xMetres;
        segment.course.toY = route.places[i + 1].yMetres;
        segment.course.toZ = route.places[i + 1].zMetres;
        segment.course.travelNs = segment.durationNs;
        segment.course.toneAgeNs = segment.timeNs - toNs(route.startSeconds());
        segments.push_back(segment);
    }
    if (!segments.empty()) cutLastSegment(segments, shaping);
    return segments;
}

/// Events of Tactile Brush: stationary vibrations that overlap in phase, as parts of one tone. Each begins
/// and ends at a zero crossing.
std::vector<CollisionEvent> makeStrokes(const MessageValues& values, const Route& route, int count,
                                        const EventShaping& shaping) {
    const double length = strokeSeconds(count, route.seconds());
    constexpr double minSeconds = 0.01; // two periods of 200 Hz
    if (length < minSeconds)
        values.fail("strokes", "expected so few that each lasts 0.01 s, found " + std::to_string(count) +
                                   " in " + numberText(route.seconds()) + " s");
    std::vector<CollisionEvent> strokes;
    for (int k = 0; k < count; ++k) {
        const double startSeconds = route.startSeconds() + k * strokeOnsetDelaySeconds(length);
        const ActuatorPlace place = route.placeAt(route.startSeconds() + route.seconds() * k / (count - 1));
        strokes.push_back(makeTone(values, place, startSeconds, startSeconds + length, values.spread()));
        CollisionEvent& stroke = strokes.back();
        const std::int64_t startNs = strokes.front().timeNs;
        const double playedHz = shaping(stroke).frequencyHz;
        stroke.course.toneAgeNs = nearestCrossingNs(playedHz, stroke.timeNs - startNs);
        stroke.durationNs =
            toneEndNs(playedHz, stroke.timeNs + stroke.durationNs - startNs - stroke.course.toneAgeNs);
        stroke.timeNs = startNs + stroke.course.toneAgeNs;
    }
    return strokes;
}

ActuatorPlace channelPlace(std::size_t j, const MessageValues& values, const LoadedClip& clip,
                           const PhantomPanner& panner) {
    if (values.has("place") || (clip.places.empty() && clip.channels.size() == 1)) return values.place();
    const double width = panner.fieldWidthMetres(), height = panner.fieldHeightMetres();
    if (!clip.places.empty()) return {clip.places[j].xMetres * width, clip.places[j].yMetres * height};
    const ActuatorLayout& layout = panner.layout();
    if (static_cast<int>(clip.channels.size()) != layout.count)
        values.fail("file", "expected one channel, places, or as many channels as actuators, " +
                                std::to_string(layout.count) + ", found " +
                                std::to_string(clip.channels.size()));
    const ActuatorPlace& place = layout.places[j];
    return {place.xMetres / layout.extentWidthMetres * width,
            place.yMetres / layout.extentHeightMetres * height,
            place.zMetres / layout.extentWidthMetres * width};
}

} // namespace

MessageValues::MessageValues(const PlainMessage& message, const MessageDescription& description,
                             const PhantomPanner& panner)
    : message_{message}
    , description_{description}
    , panner_{panner} {
    for (auto value = message.values.begin(); value != message.values.end(); ++value) {
        argument(value->name);
        if (std::ranges::find(message.values.begin(), value, value->name, &NamedValue::name) != value)
            fail(value->name, "expected once");
    }
}

void MessageValues::fail(std::string_view name, const std::string& what) const {
    throw MessageError{std::string(name) + ": " + what};
}

const PlainValue* MessageValues::find(std::string_view name) const {
    const auto found = std::ranges::find(message_.values, name, &NamedValue::name);
    return found == message_.values.end() ? nullptr : &found->value;
}

const MessageArgument& MessageValues::argument(std::string_view name) const {
    for (const MessageArgument& candidate : description_.arguments)
        if (candidate.name == name) return candidate;
    for (const MessageArgument& common : messages::timeArguments)
        if (common.name == name && !description_.isQuery()) return common;
    throw MessageError{"has no " + inQuotes(name)};
}

double MessageValues::inRange(const MessageArgument& argument, double found) const {
    if (!(found >= argument.minimum && found <= argument.maximum))
        fail(argument.name, "expected " + numberText(argument.minimum) + " to " +
                                plainNumber(argument.maximum) + ", found " + numberText(found));
    return found;
}

double MessageValues::number(std::string_view name) const {
    const MessageArgument& entry = argument(name);
    const PlainValue* const value = find(name);
    if (value == nullptr) return parseNumber<double>(entry.defaultText).value_or(0.0);
    const auto* const found = std::get_if<double>(value);
    if (found == nullptr) fail(name, "expected a number");
    return inRange(entry, *found);
}

int MessageValues::wholeNumber(std::string_view name) const {
    const double found = number(name);
    if (found != std::floor(found)) fail(name, "expected a whole number, found " + numberText(found));
    return static_cast<int>(found);
}

std::string MessageValues::text(std::string_view name) const {
    const PlainValue* const value = find(name);
    if (value == nullptr) return std::string(argument(name).defaultText);
    const auto* const found = std::get_if<std::string>(value);
    if (found == nullptr) fail(name, "expected a word");
    return *found;
}

bool MessageValues::isText(std::string_view name) const {
    const PlainValue* const value = find(name);
    return value != nullptr && std::holds_alternative<std::string>(*value);
}

std::vector<double> MessageValues::numbers(std::string_view name) const {
    const PlainValue* const value = find(name);
    const auto* const found = value == nullptr ? nullptr : std::get_if<std::vector<double>>(value);
    if (found == nullptr) fail(name, "expected a list of numbers");
    double last = -1.0;
    for (const double number : *found) {
        if (inRange(argument(name), number) <= last)
            fail(name, "expected rising numbers, found " + numberText(number) + " after " + numberText(last));
        last = number;
    }
    return *found;
}

Spread MessageValues::spread() const {
    const std::string name = text("law");
    if (name == nameOf(PanningLaw::automatic)) return panner_.travelSpread();
    const auto found = std::ranges::find(spreadNames, name);
    if (found != spreadNames.end()) return static_cast<Spread>(found - spreadNames.begin());
    fail("law", "expected one of " + nameList(spreadNames) + ", found " + inQuotes(name));
}

ActuatorPlace MessageValues::actuatorPlace(std::string_view name, char letter) const {
    const ActuatorLayout& layout = panner_.layout();
    const int j = letter - 'A';
    if (j < 0 || j >= layout.count || letter > 'Z')
        fail(name, "expected " + std::string(layout.count > 1 ? "letters from A to " : "the letter ") +
                       static_cast<char>('A' + std::min(layout.count, 26) - 1) + ", found " +
                       inQuotes({&letter, 1}));
    const ActuatorPlace& place = layout.places[static_cast<std::size_t>(j)];
    return {place.xMetres * panner_.fieldWidthMetres() / layout.extentWidthMetres,
            place.yMetres * panner_.fieldHeightMetres() / layout.extentHeightMetres,
            place.zMetres * panner_.fieldWidthMetres() / layout.extentWidthMetres};
}

ActuatorPlace MessageValues::place() const {
    const PlainValue* const value = find("place");
    if (value == nullptr) return {0.5 * panner_.fieldWidthMetres(), 0.5 * panner_.fieldHeightMetres()};
    if (const auto* letter = std::get_if<std::string>(value); letter != nullptr && letter->size() == 1)
        return actuatorPlace("place", letter->front());
    const auto* const found = std::get_if<std::vector<double>>(value);
    const std::size_t count = found == nullptr ? 0 : found->size();
    if ((count != 2 && count != 3) || !std::ranges::all_of(*found, isOnSomeField))
        fail("place", "expected x and y, or x, y and z in metres, or an actuator's letter");
    return {(*found)[0], (*found)[1], count == 3 ? (*found)[2] : 0.0};
}

std::vector<ActuatorPlace> MessageValues::places() const {
    std::vector<ActuatorPlace> all;
    const PlainValue* const value = find("places");
    if (value == nullptr) fail("places", "expected places, found none");
    if (const auto* letters = std::get_if<std::string>(value))
        for (const char letter : *letters) all.push_back(actuatorPlace("places", letter));
    if (const auto* found = std::get_if<std::vector<double>>(value)) {
        if (found->size() % 2 != 0 || !std::ranges::all_of(*found, isOnSomeField))
            fail("places", "expected pairs of x and y in metres");
        for (std::size_t i = 0; i < found->size(); i += 2) all.push_back({(*found)[i], (*found)[i + 1]});
    }
    if (all.size() < 2 || all.size() > messages::maxPlaces)
        fail("places", "expected 2 to " + std::to_string(messages::maxPlaces) + " places, found " +
                           std::to_string(all.size()));
    return all;
}

void MessageValues::expectOneOf(std::initializer_list<std::string_view> names) const {
    std::string_view first;
    for (const std::string_view name : names) {
        if (!has(name)) continue;
        if (!first.empty()) fail(name, "expected either this or " + std::string(first));
        first = name;
    }
}

std::vector<CollisionEvent> strikeStrikes(const MessageValues& values, const std::vector<Material>& materials,
                                          const EventShaping& shaping) {
    values.expectOneOf({"material", "frequency_hz"});
    CollisionEvent strike = makeTone(values, values.place(), 0.0, values.number("seconds"), values.spread());
    strike.decayPerSecond = values.number("decay_per_s");
    if (values.has("material"))
        applyMaterial(strike, values, materials);
    else if (!values.has("frequency_hz"))
        values.fail("material", "expected a material, or frequency_hz");
    if (strike.decayPerSecond == 0.0 && strike.durationNs == 0)
        values.fail("seconds", "expected a length, or a decay: it would not end");
    if (isTooSlow(strike))
        values.fail(values.has("material") ? "material" : "frequency_hz", tooSlowError(strike));
    return {cutAtCrossing(strike, shaping)};
}

std::vector<CollisionEvent> phantomStrikes(const MessageValues& values, const std::vector<Material>&,
                                           const EventShaping& shaping) {
    return {cutAtCrossing(makeTone(values, values.place(), 0.0, values.number("seconds"), values.spread()),
                          shaping)};
}

std::vector<CollisionEvent> patternStrikes(const MessageValues& values, const std::vector<Material>&,
                                           const EventShaping& shaping) {
    values.expectOneOf({"pattern", "enchanters"});
    values.expectOneOf({"pattern", "pulse_s"});
    if (values.has("enchanters"))
        return makePulses(values, "enchanters", values.text("enchanters"), values.number("pulse_s"), shaping);
    const std::string label = values.text("pattern");
    const auto pattern = parsePatternLabel(label);
    if (!pattern)
        values.fail("pattern",
                    "expected one like ABA-250 (one to three actuators, then milliseconds), found " +
                        inQuotes(label));
    return makePulses(values, "pattern", label.substr(0, static_cast<std::size_t>(pattern->count)),
                      pattern->pulseSeconds, shaping);
}

std::vector<CollisionEvent> pathStrikes(const MessageValues& values, const std::vector<Material>&,
                                        const EventShaping& shaping) {
    values.expectOneOf({"seconds", "speed_m_per_s", "times_s"});
    const Route route = values.has("times_s") ? timedRoute(values) : steadyRoute(values);
    const int strokes = values.wholeNumber("strokes");
    if (strokes == 1) values.fail("strokes", "expected 0, or 2 and more, found 1");
    return strokes == 0 ? makeMotion(values, route, shaping) : makeStrokes(values, route, strokes, shaping);
}

std::vector<CollisionEvent> clipStrikes(const MessageValues& values, const LoadedClip& clip,
                                        const PhantomPanner& panner) {
    std::vector<CollisionEvent> strikes;
    for (std::size_t j = 0; j < clip.channels.size(); ++j) {
        const ActuatorPlace place = channelPlace(j, values, clip, panner);
        const ContactRecording& channel = clip.channels[j];
        CollisionEvent& strike = strikes.emplace_back();
        strike.frequencyHz = clipFrequencyHz;
        strike.amplitude = values.number("level");
        strike.x = place.xMetres;
        strike.y = place.yMetres;
        strike.z = place.zMetres;
        // so that the last sample is included
        strike.durationNs = toNs(static_cast<double>(channel.samples.size()) / channel.sampleRateHz) + 1;
        strike.spread = values.spread();
    }
    return strikes;
}

} // namespace physvib
