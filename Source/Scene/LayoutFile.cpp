// SPDX-License-Identifier: MIT
// Reads layout files with checks of every field, and writes them in a fixed order.
#include "Scene/LayoutFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Text/NumberText.h"
#include "Scene/LayoutJson.h"
#include "Scene/PartNames.h"
#include "Scene/SceneLimits.h"
#include <algorithm>

namespace physvib {
namespace {

/// A ... Z, AA, AB, ... like the columns of a spreadsheet.
std::string letters(std::size_t index) {
    constexpr std::size_t alphabet = 26;
    const std::string last(1, static_cast<char>('A' + index % alphabet));
    return index < alphabet ? last : letters(index / alphabet - 1) + last;
}

bool isTaken(const std::vector<EnchanterDescription>& enchanters, std::string_view label) {
    return std::ranges::find(enchanters, label, &EnchanterDescription::label) != enchanters.end();
}

void fillLabels(std::vector<EnchanterDescription>& enchanters) {
    std::size_t next = 0;
    for (EnchanterDescription& enchanter : enchanters) {
        if (!enchanter.label.empty()) continue;
        while (isTaken(enchanters, letters(next))) ++next;
        enchanter.label = letters(next);
    }
}

/// One actuator of a file, within the extent of its layout.
struct PlacedEnchanter {
    EnchanterDescription described;
    EnchanterPlace place;
    double extentWidthMetres = 0.0, extentHeightMetres = 0.0;
};

void visitFields(auto& v, FieldsOf<PlacedEnchanter>) {
    constexpr auto described = &PlacedEnchanter::described;
    constexpr auto place = &PlacedEnchanter::place;
    v.field("label", in(described, &EnchanterDescription::label), kinds::text, Need::filled);
    v.field("x_m", in(place, &EnchanterPlace::xMetres), kinds::upTo(v.object.extentWidthMetres));
    v.field("y_m", in(place, &EnchanterPlace::yMetres), kinds::upTo(v.object.extentHeightMetres));
    v.field("z_m", in(place, &EnchanterPlace::zMetres),
            kinds::within(-limits::mostExtentMetres, limits::mostExtentMetres), Need::optional);
    v.field("part", in(described, &EnchanterDescription::part), kinds::name, Need::optional);
    v.field("actuator", in(described, &EnchanterDescription::actuator), kinds::text, Need::filled);
    v.field("full_scale_g", in(described, &EnchanterDescription::fullScaleG),
            kinds::within(limits::leastFullScaleG, limits::mostFullScaleG), Need::filled);
}

EnchanterDescription readEnchanter(const JsonField& json, const LayoutDescription& layout,
                                   EnchanterPlace& place) {
    PlacedEnchanter one{{}, {}, layout.geometry.extentWidthMetres, layout.geometry.extentHeightMetres};
    readTable(json, one);
    const std::string& label = one.described.label;
    if (json.has("label") && label.empty()) json["label"].fail("expected a label, found an empty string");
    if (!label.empty() && isTaken(layout.enchanters, label))
        json["label"].fail("expected a label of its own, found " + inQuotes(label) + " again");
    place = one.place;
    place.part = partOf(one.described.part);
    return one.described;
}

void readEnchanters(const JsonField& list, LayoutDescription& layout) {
    EnchanterLayout& geometry = layout.geometry;
    const std::size_t count = list.arraySize();
    if (count == 0) list.fail("expected at least 1 actuator, found none");
    if (count > geometry.places.size())
        list.fail("expected at most " + std::to_string(geometry.places.size()) + " actuators, found " +
                  std::to_string(count));
    for (std::size_t j = 0; j < count; ++j)
        layout.enchanters.push_back(readEnchanter(list.item(j), layout, geometry.places[j]));
    geometry.count = static_cast<int>(count);
    fillLabels(layout.enchanters);
}

struct Extent {}; // a kind

std::pair<double, double> readKind(const JsonField& json, const Extent&) {
    if (const std::size_t size = json.arraySize(); size != 2)
        json.fail("expected [width, height], found " + std::to_string(size) + " items");
    constexpr auto range = kinds::within(limits::leastExtentMetres, limits::mostExtentMetres);
    return {range(json.item(0)), range(json.item(1))};
}
OrderedJson writeKind(const Extent&, const auto& lengths) { return lengths; }

} // namespace

void visitFields(auto& v, FieldsOf<LayoutDescription>) {
    constexpr auto geometry = &LayoutDescription::geometry;
    v.field("name", &LayoutDescription::name, kinds::text, Need::filled);
    v.field("extent_m",
            both(in(geometry, &EnchanterLayout::extentWidthMetres),
                 in(geometry, &EnchanterLayout::extentHeightMetres)),
            Extent{});
    v.part("enchanters");
}

LayoutDescription readKind(const JsonField& json, const Own<LayoutDescription>&) {
    LayoutDescription layout;
    readTable(json, layout);
    readEnchanters(json["enchanters"], layout);
    return layout;
}

OrderedJson writeKind(const Own<LayoutDescription>&, const LayoutDescription& layout) {
    OrderedJson json = writeTable(layout);
    for (std::size_t j = 0; j < layout.enchanters.size(); ++j)
        json["enchanters"].push_back(
            writeTable(PlacedEnchanter{layout.enchanters[j], layout.geometry.places[j]}));
    return json;
}

LayoutDescription describeLayout(std::string name, const EnchanterLayout& geometry) {
    LayoutDescription layout{std::move(name), geometry, {}};
    layout.enchanters.resize(static_cast<std::size_t>(geometry.count));
    for (std::size_t j = 0; j < layout.enchanters.size(); ++j)
        layout.enchanters[j].part = PartNames{}.of(geometry.places[j].part);
    fillLabels(layout.enchanters);
    return layout;
}

LayoutDescription presetLayout(std::string_view name, const std::vector<EnchanterDescription>& before) {
    EnchanterLayout geometry;
    layoutPreset(name, geometry);
    LayoutDescription layout = describeLayout(std::string{name}, geometry);
    keepActuators(layout, before);
    return layout;
}

Result<LayoutDescription> findLayout(const std::string& nameOrPath) {
    EnchanterLayout preset;
    return layoutPreset(nameOrPath, preset) ? describeLayout(nameOrPath, preset) : loadLayout(nameOrPath);
}

Result<LayoutDescription> readLayout(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxLayoutFileBytes,
                    [](const Json& root) { return readKind(JsonField(root, {}), Own<LayoutDescription>{}); });
}

Result<LayoutDescription> loadLayout(const std::filesystem::path& path) {
    return loadText(path, limits::maxLayoutFileBytes, readLayout);
}

std::string layoutJson(const LayoutDescription& layout) {
    const OrderedJson json = writeKind(Own<LayoutDescription>{}, layout);
    std::string text = "{";
    for (const auto& [name, value] : json.items()) {
        text += (text.size() > 1 ? ",\n  \"" : "\n  \"") + name + "\": ";
        if (!value.is_array() || value.front().is_number()) {
            text += jsonLine(value);
            continue;
        }
        text += "[";
        for (std::size_t j = 0; j < value.size(); ++j)
            text += (j > 0 ? ",\n    " : "\n    ") + jsonLine(value[j]);
        text += "\n  ]";
    }
    return text + "\n}\n";
}

void keepActuators(LayoutDescription& layout, const std::vector<EnchanterDescription>& before) {
    const std::size_t kept = std::min(layout.enchanters.size(), before.size());
    for (std::size_t j = 0; j < kept; ++j) {
        layout.enchanters[j].actuator = before[j].actuator;
        layout.enchanters[j].fullScaleG = before[j].fullScaleG;
    }
}

} // namespace physvib
