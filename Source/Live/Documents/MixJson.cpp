// SPDX-License-Identifier: MIT
// Fields of the desk, its strips and their equalisers, with their ranges.
#include "Live/Documents/MixJson.h"
#include "Core/Limits.h"
#include "Io/Text/NumberText.h"
#include "Scene/LayoutJson.h"
#include "Scene/SceneFileLimits.h"

namespace physvib {
namespace {

constexpr int mostOutputs = 1024;
constexpr const char* oldDrag = "drag_ns_per_m"; // up to session format 3, per metre of the field; what was
                                                 // dragged then stands in the inputs as it was

constexpr double mostLaneSeconds = static_cast<double>(limits::maxSessionNs) / 1e9;

GainLane readLane(const JsonField& list) {
    if (list.arraySize() > mostGainPoints)
        list.fail("expected at most " + std::to_string(mostGainPoints) + " points");
    GainLane lane;
    for (std::size_t i = 0; i < list.arraySize(); ++i) {
        const JsonField point = list.item(i);
        if (point.arraySize() != 2) point.fail("expected [seconds, dB]");
        const double least = lane.empty() ? 0.0 : lane.back().seconds;
        lane.push_back({point.item(0).numberWithin(least, mostLaneSeconds),
                        point.item(1).numberWithin(leastStripDb, mostStripDb)});
    }
    return lane;
}

OrderedJson laneJson(const GainLane& lane) {
    OrderedJson list = OrderedJson::array();
    for (const GainPoint& point : lane) list.push_back({point.seconds, point.db});
    return list;
}

StripGroup readGroup(const JsonField& json) {
    json.expectObject({"name", "gain_db", "mute", "lane"});
    StripGroup group{.name = json["name"].text()};
    group.gainDb = json["gain_db"].numberWithin(leastStripDb, mostStripDb);
    group.isMuted = json["mute"].truth();
    if (json.has("lane")) group.lane = readLane(json["lane"]);
    return group;
}

std::vector<StripGroup> readGroups(const JsonField& list) {
    if (list.arraySize() > mostGroups)
        list.fail("expected at most " + std::to_string(mostGroups) + " groups");
    std::vector<StripGroup> groups;
    for (std::size_t i = 0; i < list.arraySize(); ++i) groups.push_back(readGroup(list.item(i)));
    return groups;
}

OrderedJson groupsJson(const std::vector<StripGroup>& groups) {
    OrderedJson list = OrderedJson::array();
    for (const StripGroup& g : groups) {
        list.push_back({{"name", g.name}, {"gain_db", g.gainDb}, {"mute", g.isMuted}});
        if (!g.lane.empty()) list.back()["lane"] = laneJson(g.lane);
    }
    return list;
}

Strip readStrip(const JsonField& json, Outputs outputs) {
    if (outputs == Outputs::chosen)
        json.expectObject(
            {"gain_db", "mute", "solo", "invert", "delay_ms", "ceiling_db", "output", "group", "lane"});
    else
        json.expectObject({"gain_db", "mute", "solo", "invert", "delay_ms", "ceiling_db"});
    Strip strip;
    strip.gainDb = json["gain_db"].numberWithin(leastStripDb, mostStripDb);
    strip.isMuted = json["mute"].truth();
    strip.isSolo = json["solo"].truth();
    strip.isInverted = json["invert"].truth();
    strip.delayMs = json["delay_ms"].numberWithin(0.0, 1e3 * limits::maxChannelDelaySeconds);
    strip.ceilingDb = json["ceiling_db"].numberWithin(leastCeilingDb, 0.0);
    if (outputs == Outputs::chosen)
        strip.output = static_cast<int>(json["output"].numberWithin(0, mostOutputs)) - 1; // people count from
                                                                                          // 1; 0: none
    if (json.has("group"))
        strip.group = static_cast<int>(json["group"].numberWithin(1, mostGroups)) - 1; // the same
    if (json.has("lane")) strip.lane = readLane(json["lane"]);
    return strip;
}

} // namespace

std::vector<Strip> readStrips(const JsonField& list, int enchanters, Outputs outputs) {
    if (list.arraySize() != static_cast<std::size_t>(enchanters))
        list.fail("expected one strip per actuator, " + std::to_string(enchanters));
    std::vector<Strip> strips;
    for (std::size_t j = 0; j < list.arraySize(); ++j) {
        strips.push_back(readStrip(list.item(j), outputs));
        if (outputs == Outputs::inOrder) strips.back().output = static_cast<int>(j);
    }
    return strips;
}

OrderedJson stripsJson(std::span<const Strip> strips, Outputs outputs) {
    OrderedJson list = OrderedJson::array();
    for (const Strip& s : strips) {
        list.push_back({{"gain_db", s.gainDb},
                        {"mute", s.isMuted},
                        {"solo", s.isSolo},
                        {"invert", s.isInverted},
                        {"delay_ms", s.delayMs},
                        {"ceiling_db", s.ceilingDb}});
        if (outputs != Outputs::chosen) continue;
        list.back()["output"] = s.output + 1;
        if (s.group >= 0) list.back()["group"] = s.group + 1;
        if (!s.lane.empty()) list.back()["lane"] = laneJson(s.lane);
    }
    return list;
}

FrequencyBand readBand(const JsonField& json) {
    if (json.arraySize() != 2) json.fail("expected [lowest, highest]");
    const auto hz = [&](std::size_t i) {
        return json.item(i).numberWithin(limits::leastMeasuredHz, limits::maxFrequencyHz);
    };
    const FrequencyBand band{hz(0), hz(1)};
    if (!band.isKnown()) json.fail("expected a highest frequency above the lowest");
    return band;
}

OrderedJson bandJson(const FrequencyBand& band) { return {band.lowHz, band.highHz}; }

EqualisedActuators readEqualised(const JsonField& list, int channels) {
    if (list.arraySize() != static_cast<std::size_t>(channels))
        list.fail("expected " + std::to_string(channels) + " items, one per channel");
    EqualisedActuators equalised{};
    for (std::size_t j = 0; j < list.arraySize(); ++j) {
        const JsonField item = list.item(j);
        if (item.isNull()) continue;
        item.expectObject({"resonance_hz", "q", "band_hz"});
        const Resonator resonator{
            item["resonance_hz"].numberWithin(limits::leastMeasuredHz, limits::maxFrequencyHz),
            item["q"].numberWithin(limits::leastQ, limits::mostQ)};
        equalised[j] = {resonator, readBand(item["band_hz"])};
    }
    return equalised;
}

OrderedJson equalisedJson(const EqualisedActuators& equalised, int channels) {
    OrderedJson list = OrderedJson::array();
    for (std::size_t j = 0; j < static_cast<std::size_t>(channels); ++j) {
        const auto& [resonator, band] = equalised[j];
        if (!equalised[j].isKnown())
            list.push_back(nullptr);
        else
            list.push_back(
                {{"resonance_hz", resonator.resonanceHz}, {"q", resonator.q}, {"band_hz", bandJson(band)}});
    }
    return list;
}

Mix readMix(const JsonField& json) {
    json.expectObject(
        {"layout", "law", "exponent", "level_db", "drag_ns_per_screen_m", oldDrag, "strips", "groups"});
    Mix mix;
    mix.layout = readLayoutFields(json["layout"]);
    mix.law = panningLaws[json["law"].oneOf(panningLawNames)].law;
    mix.exponent = json["exponent"].numberWithin(1e-3, 100.0);
    mix.levelDb = json["level_db"].numberWithin(leastStripDb, 0.0);
    for (const char* const name : {oldDrag, "drag_ns_per_screen_m"})
        if (json.has(name))
            mix.dragNewtonSecondsPerScreenMetre = json[name].numberWithin(leastDrag, mostDrag);
    mix.strips = readStrips(json["strips"], mix.count(), Outputs::chosen);
    if (json.has("groups")) mix.groups = readGroups(json["groups"]);
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        if (const int group = mix.strips[j].group; group >= std::ssize(mix.groups))
            json["strips"].item(j)["group"].fail("expected a group that is listed, of " +
                                                 std::to_string(mix.groups.size()) + ", found " +
                                                 std::to_string(group + 1));
    return mix;
}

OrderedJson mixJson(const Mix& mix) {
    OrderedJson json{{"layout", OrderedJson::parse(layoutJson(mix.layout))},
                     {"law", nameOf(mix.law)},
                     {"exponent", mix.exponent},
                     {"level_db", mix.levelDb},
                     {"drag_ns_per_screen_m", mix.dragNewtonSecondsPerScreenMetre},
                     {"strips", stripsJson(mix.strips, Outputs::chosen)}};
    if (!mix.groups.empty()) json["groups"] = groupsJson(mix.groups);
    return json;
}

} // namespace physvib
