// SPDX-License-Identifier: MIT
// Reads and writes strips, lanes and equalisers as JSON, and checks the fields of a mixer state against each
// other.
#include "Live/Documents/MixJson.h"
#include "Core/Limits.h"
#include "Scene/SceneFileLimits.h"

namespace physvib {

void visitFields(auto& v, FieldsOf<EqualisedActuator>) {
    constexpr auto resonator = &EqualisedActuator::resonator;
    v.field("resonance_hz", in(resonator, &Resonator::resonanceHz),
            kinds::within(limits::leastMeasuredHz, limits::maxFrequencyHz));
    v.field("q", in(resonator, &Resonator::q), kinds::within(limits::leastQ, limits::mostQ));
    v.field("band_hz", &EqualisedActuator::band, Own<FrequencyBand>{});
}

GainLane readKind(const JsonField& list, const Own<GainLane>&) {
    constexpr double mostSeconds = static_cast<double>(limits::maxSessionNs) / 1e9;
    if (list.arraySize() > mostGainPoints)
        list.fail("expected at most " + std::to_string(mostGainPoints) + " points");
    GainLane lane;
    for (std::size_t i = 0; i < list.arraySize(); ++i) {
        const JsonField point = list.item(i);
        if (point.arraySize() != 2) point.fail("expected [seconds, dB]");
        const double least = lane.empty() ? 0.0 : lane.back().seconds;
        lane.push_back({point.item(0).numberWithin(least, mostSeconds), stripRangeDb(point.item(1))});
    }
    return lane;
}

OrderedJson writeKind(const Own<GainLane>&, const GainLane& lane) {
    OrderedJson list = OrderedJson::array();
    for (const GainPoint& point : lane) list.push_back({point.seconds, point.db});
    return list;
}

namespace {

void expectStrips(const JsonField& list, int count) {
    if (list.arraySize() != static_cast<std::size_t>(count))
        list.fail("expected one strip per actuator, " + std::to_string(count));
}

} // namespace

std::vector<Strip> readKind(const JsonField& list, const PerChannel<std::vector<Strip>>& kind) {
    expectStrips(list, kind.channels);
    return kinds::Objects<Strip>{}(list);
}

OrderedJson writeKind(const PerChannel<std::vector<Strip>>&, const std::vector<Strip>& strips) {
    return kinds::Objects<Strip>{}.write(strips);
}

std::vector<Strip> readKind(const JsonField& list, const kinds::PluginStrips& kind) {
    expectStrips(list, kind.count);
    std::vector<Strip> strips(list.arraySize());
    for (std::size_t j = 0; j < strips.size(); ++j) {
        readTable<Strip, PluginStrip>(list.item(j), strips[j]);
        strips[j].output = static_cast<int>(j);
    }
    return strips;
}

OrderedJson writeKind(const kinds::PluginStrips& kind, const std::vector<Strip>& strips) {
    std::vector<Strip> whole = strips;
    resizeStrips(whole, kind.count);
    OrderedJson list = OrderedJson::array();
    for (const Strip& strip : whole) list.push_back(writeTable<Strip, PluginStrip>(strip));
    return list;
}

FrequencyBand readKind(const JsonField& json, const Own<FrequencyBand>&) {
    if (json.arraySize() != 2) json.fail("expected [lowest, highest]");
    const auto hz = [&](std::size_t i) {
        return json.item(i).numberWithin(limits::leastMeasuredHz, limits::maxFrequencyHz);
    };
    const FrequencyBand band{hz(0), hz(1)};
    if (!band.isKnown()) json.fail("expected a highest frequency above the lowest");
    return band;
}

OrderedJson writeKind(const Own<FrequencyBand>&, const FrequencyBand& band) {
    return {band.lowHz, band.highHz};
}

EqualisedActuators readKind(const JsonField& list, const PerChannel<EqualisedActuators>& kind) {
    if (list.arraySize() != static_cast<std::size_t>(kind.channels))
        list.fail("expected " + std::to_string(kind.channels) + " items, one per channel");
    EqualisedActuators equalised{};
    for (std::size_t j = 0; j < list.arraySize(); ++j)
        if (!list.item(j).isNull()) readTable(list.item(j), equalised[j]);
    return equalised;
}

OrderedJson writeKind(const PerChannel<EqualisedActuators>& kind, const EqualisedActuators& equalised) {
    OrderedJson list = OrderedJson::array();
    for (std::size_t j = 0; j < static_cast<std::size_t>(kind.channels); ++j)
        list.push_back(equalised[j].isKnown() ? writeTable(equalised[j]) : OrderedJson());
    return list;
}

Mix readMix(const JsonField& json) {
    Mix mix;
    readTable(json, mix);
    for (std::size_t j = 0; j < mix.strips.size(); ++j)
        if (const int group = mix.strips[j].group; group >= std::ssize(mix.groups))
            json["strips"].item(j)["group"].fail("expected a group that is listed, of " +
                                                 std::to_string(mix.groups.size()) + ", found " +
                                                 std::to_string(group + 1));
    return mix;
}

} // namespace physvib
