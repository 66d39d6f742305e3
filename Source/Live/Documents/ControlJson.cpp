// SPDX-License-Identifier: MIT
// Reads and writes render controls and panners as JSON, with their value ranges.
#include "Live/Documents/ControlJson.h"
#include "Scene/LayoutJson.h"
#include "Scene/SceneFileLimits.h"
#include <algorithm>
#include <string>
#include <vector>

namespace physvib {
namespace {

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
    json.expectOnly(known);
}

} // namespace

PhantomPanner readKind(const JsonField& json, const DescribedPanner<LayoutDescription>& kind) {
    json.expectObject({"layout", "law", "exponent", "field_m", "grain_law", "part_law"});
    kind.described = readKind(json["layout"], Own<LayoutDescription>{});
    const auto& layout = kind.described.geometry;
    if (layout.count > kind.channels)
        json["layout"].fail("expected at most " + std::to_string(kind.channels) +
                            " actuators, as many as there are channels");
    const JsonField field = json["field_m"];
    if (field.arraySize() != 2) field.fail("expected [width, height]");
    PhantomPanner panner{layout, panningLaws[json["law"].oneOf(panningLawNames)].law,
                         exponentRange(json["exponent"]),
                         field.item(0).numberWithin(limits::leastExtentMetres, limits::mostExtentMetres),
                         field.item(1).numberWithin(limits::leastExtentMetres, limits::mostExtentMetres)};
    // without this field, grains are panned like impacts
    if (json.has("grain_law"))
        panner.setGrains(spreadBy(panningLaws[json["grain_law"].oneOf(panningLawNames)].law));
    // without this field parts are panned by `law`
    const char* const partLaw = json.has("part_law") ? "part_law" : "law";
    panner.setPartLaw(panningLaws[json[partLaw].oneOf(panningLawNames)].law);
    return panner;
}

OwnedControl readControl(const JsonField& json, int channels, std::string_view otherField) {
    using Holds = ControlDescription::Holds;
    json.expectObject();
    const ControlDescription& one = controlTable[json["control"].oneOf(controlNames)];
    OwnedControl control;
    control.kind = one.kind;
    if (one.holds == Holds::nothing)
        expectFields(json, {}, otherField);
    else if (one.holds == Holds::panner) {
        expectFields(json, {one.field}, otherField);
        LayoutDescription unused;
        control.kept = std::make_shared<const PhantomPanner>(
            readKind(json[one.field], DescribedPanner{channels, unused}));
        control.panner = control.kept.get();
    } else {
        expectFields(json, {"channel", one.field}, otherField);
        control.channel = readChannel(json["channel"], channels);
        if (one.holds == Holds::truth)
            control.value = json[one.field].truth() ? 1.0f : 0.0f;
        else
            control.value = static_cast<float>(json[one.field].numberWithin(one.least, one.most));
    }
    return control;
}

OrderedJson writeKind(const DescribedPanner<const LayoutDescription>& kind, const PhantomPanner& panner) {
    const bool isKnown = !kind.described.enchanters.empty();
    OrderedJson json{{"layout", writeKind(Own<LayoutDescription>{},
                                          isKnown ? kind.described : describeLayout("", panner.layout()))},
                     {"law", nameOf(panner.law())},
                     {"exponent", panner.exponent()},
                     {"field_m", {panner.fieldWidthMetres(), panner.fieldHeightMetres()}}};
    if (panner.grains() != Spread::layout) json["grain_law"] = nameOf(panner.grains());
    if (panner.partLaw() != panner.law() && hasParts(panner.layout()))
        json["part_law"] = nameOf(panner.partLaw());
    return json;
}

OrderedJson controlJson(const RenderControl& control) {
    using Holds = ControlDescription::Holds;
    // every control that is written is in the table
    const auto one = std::ranges::find(controlTable, control.kind, &ControlDescription::kind);
    OrderedJson json{{"control", one->name}};
    if (one->holds == Holds::panner)
        json[one->field] =
            writeKind(DescribedPanner<const LayoutDescription>{control.channel, {}}, *control.panner);
    if (one->holds == Holds::number || one->holds == Holds::truth) json["channel"] = control.channel + 1;
    if (one->holds == Holds::number) json[one->field] = static_cast<double>(control.value);
    if (one->holds == Holds::truth) json[one->field] = control.value != 0.0f;
    return json;
}

} // namespace physvib
