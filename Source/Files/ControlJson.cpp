// SPDX-License-Identifier: MIT
// Fields of controls and panners, with their ranges.
#include "Files/ControlJson.h"
#include "Files/Disk/FileLimits.h"
#include "Files/LayoutJson.h"
#include <cmath>
#include <string>
#include <vector>

namespace physvib {
namespace {

constexpr double leastExponent = 1e-3, mostExponent = 100.0;
constexpr double largestGain = 1000.0, leastCeiling = 1e-6;

int readChannel(const JsonField& field, int channels) {
    const int found = field.wholeNumber();
    if (found < 1 || found > channels)
        field.fail("expected a channel from 1 to " + std::to_string(channels) + ", found " + std::to_string(found));
    return found - 1;
}

void expectFields(const JsonField& json, std::vector<std::string_view> known, std::string_view other) {
    known.push_back("control");
    if (!other.empty()) known.push_back(other);
    json.expectOnly(known);
}

} // namespace

PhantomPanner readPanner(const JsonField& json, int channels) {
    json.expectObject({"layout", "law", "exponent", "field_m"});
    const auto layout = readLayoutFields(json["layout"]).geometry;
    if (layout.count > channels)
        json["layout"].fail("expected at most " + std::to_string(channels) + " enchanters, as many as there are channels");
    const JsonField field = json["field_m"];
    if (field.arraySize() != 2) field.fail("expected [width, height]");
    return {layout, panningLaws[json["law"].oneOf(panningLawNames)].law, json["exponent"].numberWithin(leastExponent, mostExponent),
            field.item(0).numberWithin(limits::leastExtentMetres, limits::mostExtentMetres), field.item(1).numberWithin(limits::leastExtentMetres, limits::mostExtentMetres)};
}

RenderControl readControl(const JsonField& json, int channels, std::string_view otherField) {
    using Kind = RenderControl::Kind;
    json.expectObject();
    RenderControl control;
    control.kind = static_cast<Kind>(json["control"].oneOf(controlNames));
    switch (control.kind) {
    case Kind::panner:
        expectFields(json, {"panning"}, otherField);
        control.panner = readPanner(json["panning"], channels);
        break;
    case Kind::gain:
        expectFields(json, {"channel", "value"}, otherField);
        control.channel = readChannel(json["channel"], channels);
        control.value = static_cast<float>(json["value"].numberWithin(-largestGain, largestGain));
        break;
    case Kind::mute:
        expectFields(json, {"channel", "on"}, otherField);
        control.channel = readChannel(json["channel"], channels);
        control.value = json["on"].truth() ? 1.0f : 0.0f;
        break;
    case Kind::delay:
        expectFields(json, {"channel", "seconds"}, otherField);
        control.channel = readChannel(json["channel"], channels);
        control.value = static_cast<float>(json["seconds"].numberWithin(0.0, limits::maxChannelDelaySeconds));
        break;
    case Kind::ceiling:
        expectFields(json, {"channel", "value"}, otherField);
        control.channel = readChannel(json["channel"], channels);
        control.value = static_cast<float>(json["value"].numberWithin(leastCeiling, 1.0));
        break;
    case Kind::recordings: // not among the names: a session's file lists them apart
    case Kind::level: // nor these: no file knows them
    case Kind::silence:
    case Kind::stopAll: expectFields(json, {}, otherField);
    }
    return control;
}

OrderedJson pannerJson(const PhantomPanner& panner) {
    return {{"layout", OrderedJson::parse(layoutJson(describeLayout("", panner.layout())))},
            {"law", nameOf(panner.law())},
            {"exponent", panner.exponent()},
            {"field_m", {panner.fieldWidthMetres(), panner.fieldHeightMetres()}}};
}

OrderedJson controlJson(const RenderControl& control) {
    using Kind = RenderControl::Kind;
    OrderedJson json{{"control", controlNames[static_cast<std::size_t>(control.kind)]}};
    if (control.kind == Kind::panner) json["panning"] = pannerJson(control.panner);
    if (control.kind != Kind::panner && control.kind != Kind::stopAll) json["channel"] = control.channel + 1;
    if (control.kind == Kind::delay) json["seconds"] = static_cast<double>(control.value);
    if (control.kind == Kind::gain || control.kind == Kind::ceiling) json["value"] = static_cast<double>(control.value);
    if (control.kind == Kind::mute) json["on"] = control.value != 0.0f;
    return json;
}

} // namespace physvib
