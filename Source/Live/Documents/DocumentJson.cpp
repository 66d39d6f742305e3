// SPDX-License-Identifier: MIT
// Reads and writes strips, lanes and equalisers as JSON, and checks the fields of a mixer state against each
// other.
#include "Live/Documents/DocumentJson.h"

namespace physvib {
void visitFields(auto& v, FieldsOf<EqualisedActuator>) {
    constexpr auto resonator = &EqualisedActuator::resonator;
    v.field("resonance_hz", nest(resonator, &Resonator::resonanceHz),
            kinds::range(limits::minMeasuredHz, limits::maxFrequencyHz));
    v.field("q", nest(resonator, &Resonator::q), kinds::range(limits::minQ, limits::maxQ));
    v.field("band_hz", &EqualisedActuator::band, Custom<FrequencyBand>{});
}

GainLane readCustom(const JsonField& list, const Custom<GainLane>&) {
    constexpr double maxSeconds = static_cast<double>(limits::maxSessionNs) / 1e9;
    if (list.arraySize() > maxGainPoints)
        list.fail("expected at most " + std::to_string(maxGainPoints) + " points");
    GainLane lane;
    for (std::size_t i = 0; i < list.arraySize(); ++i) {
        const JsonField point = list.item(i);
        if (point.arraySize() != 2) point.fail("expected [seconds, dB]");
        const double minSeconds = lane.empty() ? 0.0 : lane.back().seconds;
        lane.push_back({point.item(0).numberWithin(minSeconds, maxSeconds), stripRangeDb(point.item(1))});
    }
    return lane;
}

OrderedJson writeCustom(const Custom<GainLane>&, const GainLane& lane) {
    OrderedJson list = OrderedJson::array();
    for (const GainPoint& point : lane) list.push_back({point.seconds, point.db});
    return list;
}

namespace {

void expectStripCount(const JsonField& list, int count) {
    if (list.arraySize() != static_cast<std::size_t>(count))
        list.fail("expected one strip per actuator, " + std::to_string(count));
}

int readChannel(const JsonField& field, int channels) {
    const int found = field.wholeNumber();
    if (found < 1 || found > channels)
        field.fail("expected a channel from 1 to " + std::to_string(channels) + ", found " +
                   std::to_string(found));
    return found - 1;
}

void expectFields(const JsonField& json, std::vector<std::string_view> known, std::string_view other) {
    known.push_back("control");
    if (!other.empty()) known.push_back(other);
    for (const std::string& name : json.names())
        if (std::ranges::find(known, name) == known.end())
            json.fail("unknown field " + inQuotes(name) + ": expected " + nameList(known));
}

} // namespace

std::vector<Strip> readCustom(const JsonField& list, const PerChannel<std::vector<Strip>>& kind) {
    expectStripCount(list, kind.channels);
    return kinds::Objects<Strip>{}(list);
}

OrderedJson writeCustom(const PerChannel<std::vector<Strip>>&, const std::vector<Strip>& strips) {
    return kinds::Objects<Strip>{}.write(strips);
}

std::vector<Strip> readCustom(const JsonField& list, const kinds::PluginStrips& kind) {
    expectStripCount(list, kind.count);
    std::vector<Strip> strips(list.arraySize());
    for (std::size_t j = 0; j < strips.size(); ++j) {
        readTable<Strip, PluginStrip>(list.item(j), strips[j]);
        strips[j].output = static_cast<int>(j);
    }
    return strips;
}

OrderedJson writeCustom(const kinds::PluginStrips& kind, const std::vector<Strip>& strips) {
    std::vector<Strip> whole = strips;
    resizeStrips(whole, kind.count);
    OrderedJson list = OrderedJson::array();
    for (const Strip& strip : whole) list.push_back(writeTable<Strip, PluginStrip>(strip));
    return list;
}

FrequencyBand readCustom(const JsonField& json, const Custom<FrequencyBand>&) {
    if (json.arraySize() != 2) json.fail("expected [lowest, highest]");
    const auto hz = [&](std::size_t i) {
        return json.item(i).numberWithin(limits::minMeasuredHz, limits::maxFrequencyHz);
    };
    const FrequencyBand band{hz(0), hz(1)};
    if (!band.isKnown()) json.fail("expected a highest frequency above the lowest");
    return band;
}

OrderedJson writeCustom(const Custom<FrequencyBand>&, const FrequencyBand& band) {
    return {band.lowHz, band.highHz};
}

EqualisedActuators readCustom(const JsonField& list, const PerChannel<EqualisedActuators>& kind) {
    if (list.arraySize() != static_cast<std::size_t>(kind.channels))
        list.fail("expected " + std::to_string(kind.channels) + " items, one per channel");
    EqualisedActuators equalised{};
    for (std::size_t j = 0; j < list.arraySize(); ++j)
        if (!list.item(j).isNull()) readTable(list.item(j), equalised[j]);
    return equalised;
}

OrderedJson writeCustom(const PerChannel<EqualisedActuators>& kind, const EqualisedActuators& equalised) {
    OrderedJson list = OrderedJson::array();
    for (std::size_t j = 0; j < static_cast<std::size_t>(kind.channels); ++j)
        list.push_back(equalised[j].isKnown() ? writeTable(equalised[j]) : OrderedJson());
    return list;
}

std::uint32_t readCustom(const JsonField& json, const Custom<std::uint32_t>&) {
    const double found = json.numberUpTo(4294967295.0);
    if (found != std::floor(found)) json.fail("expected a whole number, found " + numberText(found));
    return static_cast<std::uint32_t>(found);
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

// Reads and writes render controls and panners as JSON, with their value ranges.

PhantomPanner readCustom(const JsonField& json, const DescribedPanner<LayoutDescription>& kind) {
    json.expectObject({"layout", "law", "exponent", "field_m", "grain_law", "part_law"});
    const JsonField described = json["layout"]; // whole, or a preset by its name
    kind.described = described.isText() ? presetLayout(layoutPresetNames[described.oneOf(layoutPresetNames)])
                                        : readCustom(described, Custom<LayoutDescription>{});
    const auto& layout = kind.described.geometry;
    if (layout.count > kind.channels)
        json["layout"].fail("expected at most " + std::to_string(kind.channels) +
                            " actuators, as many as there are channels");
    const JsonField field = json["field_m"];
    if (field.arraySize() != 2) field.fail("expected [width, height]");
    PhantomPanner panner{layout, panningLaws[json["law"].oneOf(panningLawNames)].law,
                         exponentRange(json["exponent"]),
                         field.item(0).numberWithin(limits::minExtentMetres, limits::maxExtentMetres),
                         field.item(1).numberWithin(limits::minExtentMetres, limits::maxExtentMetres)};
    // without this field, grains are panned like impacts
    if (json.has("grain_law"))
        panner.setGrains(spreadBy(panningLaws[json["grain_law"].oneOf(panningLawNames)].law));
    // without this field parts are panned by `law`
    const char* const requestedLaw = json.has("part_law") ? "part_law" : "law";
    panner.setRequestedLaw(panningLaws[json[requestedLaw].oneOf(panningLawNames)].law);
    return panner;
}

OwnedControl readControl(const JsonField& json, int channels, std::string_view otherField) {
    using ValueType = ControlDescription::ValueType;
    json.expectObject();
    const ControlDescription& entry = controlTable[json["control"].oneOf(controlNames)];
    OwnedControl control;
    control.kind = entry.kind;
    if (entry.type == ValueType::nothing)
        expectFields(json, {}, otherField);
    else if (entry.type == ValueType::panner) {
        expectFields(json, {entry.field}, otherField);
        LayoutDescription unused;
        control.ownedPanner = std::make_shared<const PhantomPanner>(
            readCustom(json[entry.field], DescribedPanner{channels, unused}));
        control.panner = control.ownedPanner.get();
    } else {
        expectFields(json, {"channel", entry.field}, otherField);
        control.channel = readChannel(json["channel"], channels);
        if (entry.type == ValueType::boolean)
            control.value = json[entry.field].boolean() ? 1.0f : 0.0f;
        else
            control.value = static_cast<float>(json[entry.field].numberWithin(entry.minimum, entry.maximum));
    }
    return control;
}

OrderedJson writeCustom(const DescribedPanner<const LayoutDescription>& kind, const PhantomPanner& panner) {
    const bool isKnown = !kind.described.actuators.empty();
    OrderedJson json{{"layout", writeCustom(Custom<LayoutDescription>{},
                                            isKnown ? kind.described : describeLayout("", panner.layout()))},
                     {"law", nameOf(panner.law())},
                     {"exponent", panner.exponent()},
                     {"field_m", {panner.fieldWidthMetres(), panner.fieldHeightMetres()}}};
    if (panner.grains() != Spread::layout) json["grain_law"] = nameOf(panner.grains());
    if (panner.requestedLaw() != panner.law() && hasParts(panner.layout()))
        json["part_law"] = nameOf(panner.requestedLaw());
    return json;
}

OrderedJson controlJson(const RenderControl& control) {
    using ValueType = ControlDescription::ValueType;
    // every control that is written is in the table
    const auto entry = std::ranges::find(controlTable, control.kind, &ControlDescription::kind);
    OrderedJson json{{"control", entry->name}};
    if (entry->type == ValueType::panner)
        json[entry->field] =
            writeCustom(DescribedPanner<const LayoutDescription>{control.channel, {}}, *control.panner);
    if (entry->type == ValueType::number || entry->type == ValueType::boolean)
        json["channel"] = control.channel + 1;
    if (entry->type == ValueType::number) json[entry->field] = static_cast<double>(control.value);
    if (entry->type == ValueType::boolean) json[entry->field] = control.value != 0.0f;
    return json;
}

std::string controlError(const RenderControl& control, int channels) {
    try {
        const Json json = parseStrictly(compactJson(controlJson(control)));
        readControl(JsonField(json, {}), channels);
        return {};
    } catch (const JsonError& error) {
        return error.what();
    }
}

} // namespace physvib
