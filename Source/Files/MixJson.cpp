// SPDX-License-Identifier: MIT
// Fields of the desk and its strips, with their ranges.
#include "Files/MixJson.h"
#include "Files/LayoutJson.h"
#include "Files/NumberText.h"
#include "Core/Limits.h"

namespace physvib {
namespace {

constexpr int mostOutputs = 1024;

Strip readStrip(const JsonField& json) {
    json.expectObject({"gain_db", "mute", "solo", "invert", "delay_ms", "ceiling_db", "output"});
    Strip strip;
    strip.gainDb = json["gain_db"].numberWithin(leastStripDb, mostStripDb);
    strip.isMuted = json["mute"].truth();
    strip.isSolo = json["solo"].truth();
    strip.isInverted = json["invert"].truth();
    strip.delayMs = json["delay_ms"].numberWithin(0.0, 1e3 * limits::maxChannelDelaySeconds);
    strip.ceilingDb = json["ceiling_db"].numberWithin(leastCeilingDb, 0.0);
    strip.output = static_cast<int>(json["output"].numberWithin(0, mostOutputs)) - 1; // people count from 1; 0: none
    return strip;
}

} // namespace

Mix readMix(const JsonField& json) {
    json.expectObject({"layout", "law", "exponent", "level_db", "drag_ns_per_m", "strips"});
    Mix mix;
    mix.layout = readLayoutFields(json["layout"]);
    mix.law = static_cast<PanningLaw>(json["law"].oneOf(panningLawNames));
    mix.exponent = json["exponent"].numberWithin(1e-3, 100.0);
    mix.levelDb = json["level_db"].numberWithin(leastStripDb, 0.0);
    if (json.has("drag_ns_per_m")) mix.dragNewtonSecondsPerMetre = json["drag_ns_per_m"].numberWithin(leastDrag, mostDrag);
    const JsonField strips = json["strips"];
    if (strips.arraySize() != static_cast<std::size_t>(mix.count())) strips.fail("expected one strip per enchanter, " + std::to_string(mix.count()));
    for (std::size_t j = 0; j < strips.arraySize(); ++j) mix.strips.push_back(readStrip(strips.item(j)));
    return mix;
}

OrderedJson mixJson(const Mix& mix) {
    OrderedJson json{{"layout", OrderedJson::parse(layoutJson(mix.layout))},
                     {"law", panningLawNames[static_cast<std::size_t>(mix.law)]},
                     {"exponent", mix.exponent},
                     {"level_db", mix.levelDb},
                     {"drag_ns_per_m", mix.dragNewtonSecondsPerMetre},
                     {"strips", OrderedJson::array()}};
    for (const Strip& s : mix.strips)
        json["strips"].push_back({{"gain_db", s.gainDb}, {"mute", s.isMuted}, {"solo", s.isSolo}, {"invert", s.isInverted},
                                  {"delay_ms", s.delayMs}, {"ceiling_db", s.ceilingDb}, {"output", s.output + 1}});
    return json;
}

} // namespace physvib
