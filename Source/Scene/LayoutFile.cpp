// SPDX-License-Identifier: MIT
// Reads layout files with checks of every field, and writes them; layouts of presets, and their labels.
#include "Scene/LayoutFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Scene/LayoutJson.h"
#include "Scene/PartNames.h"
#include "Scene/SceneLimits.h"
#include <algorithm>

namespace physvib {
namespace {

/// The label of actuator `index`: A to Z, AA, AB..., like the columns of a spreadsheet.
std::string letterLabel(std::size_t index) {
    constexpr std::size_t alphabet = 26;
    const std::string lastLetter(1, static_cast<char>('A' + index % alphabet));
    return index < alphabet ? lastLetter : letterLabel(index / alphabet - 1) + lastLetter;
}

bool isLabelUsed(const std::vector<ActuatorDescription>& actuators, std::string_view label) {
    return std::ranges::find(actuators, label, &ActuatorDescription::label) != actuators.end();
}

void fillMissingLabels(std::vector<ActuatorDescription>& actuators) {
    std::size_t nextIndex = 0;
    for (ActuatorDescription& actuator : actuators) {
        if (!actuator.label.empty()) continue;
        while (isLabelUsed(actuators, letterLabel(nextIndex))) ++nextIndex;
        actuator.label = letterLabel(nextIndex);
    }
}

/// One actuator of a file, within the extent of its layout.
struct PlacedActuator {
    ActuatorDescription description;
    ActuatorPlace place;
    double extentWidthMetres = 0.0, extentHeightMetres = 0.0;
};

void visitFields(auto& v, FieldsOf<PlacedActuator>) {
    constexpr auto description = &PlacedActuator::description;
    constexpr auto place = &PlacedActuator::place;
    v.field("label", nest(description, &ActuatorDescription::label), kinds::text, Need::filled);
    v.field("x_m", nest(place, &ActuatorPlace::xMetres), kinds::upTo(v.object.extentWidthMetres));
    v.field("y_m", nest(place, &ActuatorPlace::yMetres), kinds::upTo(v.object.extentHeightMetres));
    v.field("z_m", nest(place, &ActuatorPlace::zMetres),
            kinds::range(-limits::maxExtentMetres, limits::maxExtentMetres), Need::optional);
    v.field("part", nest(description, &ActuatorDescription::part), kinds::name, Need::optional);
    v.field("actuator", nest(description, &ActuatorDescription::actuator), kinds::text, Need::filled);
    v.field("full_scale_g", nest(description, &ActuatorDescription::fullScaleG),
            kinds::range(limits::minFullScaleG, limits::maxFullScaleG), Need::filled);
}

ActuatorDescription readPlacedActuator(const JsonField& json, const LayoutDescription& layout,
                                       ActuatorPlace& place) {
    PlacedActuator entry{{}, {}, layout.geometry.extentWidthMetres, layout.geometry.extentHeightMetres};
    readTable(json, entry);
    const std::string& label = entry.description.label;
    if (json.has("label") && label.empty()) json["label"].fail("expected a label, found an empty string");
    if (!label.empty() && isLabelUsed(layout.actuators, label))
        json["label"].fail("expected a label of its own, found " + inQuotes(label) + " again");
    place = entry.place;
    place.part = toPartNumber(entry.description.part);
    return entry.description;
}

void readActuators(const JsonField& list, LayoutDescription& layout) {
    ActuatorLayout& geometry = layout.geometry;
    const std::size_t count = list.arraySize();
    if (count == 0) list.fail("expected at least 1 actuator, found none");
    if (count > geometry.places.size())
        list.fail("expected at most " + std::to_string(geometry.places.size()) + " actuators, found " +
                  std::to_string(count));
    for (std::size_t j = 0; j < count; ++j)
        layout.actuators.push_back(readPlacedActuator(list.item(j), layout, geometry.places[j]));
    geometry.count = static_cast<int>(count);
    fillMissingLabels(layout.actuators);
}

struct Extent {}; // kind of the field extent_m

std::pair<double, double> readCustom(const JsonField& json, const Extent&) {
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected [width, height], found " + std::to_string(size) + " items");
    constexpr auto range = kinds::range(limits::minExtentMetres, limits::maxExtentMetres);
    return {range(json.item(0)), range(json.item(1))};
}
OrderedJson writeCustom(const Extent&, const auto& lengths) { return lengths; }

} // namespace

void visitFields(auto& v, FieldsOf<LayoutDescription>) {
    constexpr auto geometry = &LayoutDescription::geometry;
    v.field("name", &LayoutDescription::name, kinds::text, Need::filled);
    v.field("extent_m",
            memberPair(nest(geometry, &ActuatorLayout::extentWidthMetres),
                       nest(geometry, &ActuatorLayout::extentHeightMetres)),
            Extent{});
    v.part("enchanters");
}

LayoutDescription readCustom(const JsonField& json, const Custom<LayoutDescription>&) {
    LayoutDescription layout;
    readTable(json, layout);
    readActuators(json["enchanters"], layout);
    return layout;
}

OrderedJson writeCustom(const Custom<LayoutDescription>&, const LayoutDescription& layout) {
    OrderedJson json = writeTable(layout);
    for (std::size_t j = 0; j < layout.actuators.size(); ++j)
        json["enchanters"].push_back(
            writeTable(PlacedActuator{layout.actuators[j], layout.geometry.places[j]}));
    return json;
}

LayoutDescription describeLayout(std::string name, const ActuatorLayout& geometry) {
    LayoutDescription layout{std::move(name), geometry, {}};
    layout.actuators.resize(static_cast<std::size_t>(geometry.count));
    for (std::size_t j = 0; j < layout.actuators.size(); ++j)
        layout.actuators[j].part = PartNames{}.nameOf(geometry.places[j].part);
    fillMissingLabels(layout.actuators);
    return layout;
}

LayoutDescription presetLayout(std::string_view name, const std::vector<ActuatorDescription>& previous) {
    ActuatorLayout geometry;
    layoutPreset(name, geometry);
    LayoutDescription layout = describeLayout(std::string{name}, geometry);
    copyActuatorProperties(layout, previous);
    return layout;
}

Result<LayoutDescription> findLayout(const std::string& nameOrPath) {
    ActuatorLayout preset;
    return layoutPreset(nameOrPath, preset) ? describeLayout(nameOrPath, preset) : loadLayout(nameOrPath);
}

Result<LayoutDescription> readLayout(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxLayoutFileBytes, [](const Json& root) {
        return readCustom(JsonField(root, {}), Custom<LayoutDescription>{});
    });
}

Result<LayoutDescription> loadLayout(const std::filesystem::path& path) {
    return loadText(path, limits::maxLayoutFileBytes, readLayout);
}

std::string layoutJson(const LayoutDescription& layout) {
    const OrderedJson json = writeCustom(Custom<LayoutDescription>{}, layout);
    std::string text = "{";
    for (const auto& [name, value] : json.items()) {
        text += (text.size() > 1 ? ",\n  \"" : "\n  \"") + name + "\": ";
        if (!value.is_array() || value.front().is_number()) {
            text += compactJson(value);
            continue;
        }
        text += "[";
        for (std::size_t j = 0; j < value.size(); ++j)
            text += (j > 0 ? ",\n    " : "\n    ") + compactJson(value[j]);
        text += "\n  ]";
    }
    return text + "\n}\n";
}

void copyActuatorProperties(LayoutDescription& layout, const std::vector<ActuatorDescription>& previous) {
    const std::size_t count = std::min(layout.actuators.size(), previous.size());
    for (std::size_t j = 0; j < count; ++j) {
        layout.actuators[j].actuator = previous[j].actuator;
        layout.actuators[j].fullScaleG = previous[j].fullScaleG;
    }
}

} // namespace physvib
