// SPDX-License-Identifier: MIT
// Reads layout files with checks of every field, and writes them in a fixed order.
#include "Scene/LayoutFile.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonLines.h"
#include "Io/Json/JsonText.h"
#include "Io/Json/StrictJson.h"
#include "Io/Text/NumberText.h"
#include "Scene/LayoutJson.h"
#include "Scene/SceneFileLimits.h"
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

void readExtent(const JsonField& extent, EnchanterLayout& geometry) {
    if (const std::size_t size = extent.arraySize(); size != 2)
        extent.fail("expected [width, height], found " + std::to_string(size) + " items");
    geometry.extentWidthMetres =
        extent.item(0).numberWithin(limits::leastExtentMetres, limits::mostExtentMetres);
    geometry.extentHeightMetres =
        extent.item(1).numberWithin(limits::leastExtentMetres, limits::mostExtentMetres);
}

std::string readLabel(const JsonField& label, const std::vector<EnchanterDescription>& before) {
    std::string text = label.text();
    if (text.empty()) label.fail("expected a label, found an empty string");
    if (isTaken(before, text)) label.fail("expected a label of its own, found " + inQuotes(text) + " again");
    return text;
}

EnchanterDescription readEnchanter(const JsonField& field, const std::vector<EnchanterDescription>& before) {
    field.expectObject({"label", "x_m", "y_m", "actuator", "full_scale_g"});
    EnchanterDescription enchanter;
    if (field.has("label")) enchanter.label = readLabel(field["label"], before);
    if (field.has("actuator")) enchanter.actuator = field["actuator"].text();
    if (field.has("full_scale_g"))
        enchanter.fullScaleG =
            field["full_scale_g"].numberWithin(limits::leastFullScaleG, limits::mostFullScaleG);
    return enchanter;
}

void readEnchanters(const JsonField& list, LayoutDescription& layout) {
    EnchanterLayout& geometry = layout.geometry;
    const std::size_t count = list.arraySize();
    if (count == 0) list.fail("expected at least 1 actuator, found none");
    if (count > geometry.places.size())
        list.fail("expected at most " + std::to_string(geometry.places.size()) + " actuators, found " +
                  std::to_string(count));
    for (std::size_t j = 0; j < count; ++j) {
        const JsonField enchanter = list.item(j);
        layout.enchanters.push_back(readEnchanter(enchanter, layout.enchanters));
        geometry.places[j] = {enchanter["x_m"].numberUpTo(geometry.extentWidthMetres),
                              enchanter["y_m"].numberUpTo(geometry.extentHeightMetres)};
    }
    geometry.count = static_cast<int>(count);
    fillLabels(layout.enchanters);
}

} // namespace

LayoutDescription readLayoutFields(const JsonField& root) {
    root.expectObject({"name", "extent_m", "enchanters"});
    LayoutDescription layout;
    if (root.has("name")) layout.name = root["name"].text();
    readExtent(root["extent_m"], layout.geometry);
    readEnchanters(root["enchanters"], layout);
    return layout;
}

namespace {

/// Invalid UTF-8 is replaced by U+FFFD, because JSON does not allow it.
std::string jsonText(const std::string& text) {
    return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string enchanterJson(const EnchanterDescription& enchanter, const EnchanterPlace& place) {
    return "    { \"label\": " + jsonText(enchanter.label) + ", \"x_m\": " + jsonNumber(place.xMetres) +
           ", \"y_m\": " + jsonNumber(place.yMetres) + ", \"actuator\": " + jsonText(enchanter.actuator) +
           ", \"full_scale_g\": " + jsonNumber(enchanter.fullScaleG) + " }";
}

} // namespace

LayoutDescription describeLayout(std::string name, const EnchanterLayout& geometry) {
    LayoutDescription layout{std::move(name), geometry, {}};
    layout.enchanters.resize(static_cast<std::size_t>(geometry.count));
    fillLabels(layout.enchanters);
    return layout;
}

LayoutDescription presetLayout(std::string_view name, const std::vector<EnchanterDescription>& before) {
    EnchanterLayout geometry;
    layoutPreset(name, geometry);
    LayoutDescription layout = describeLayout(std::string{name}, geometry);
    for (std::size_t j = 0; j < std::min(layout.enchanters.size(), before.size()); ++j) {
        layout.enchanters[j].actuator = before[j].actuator;
        layout.enchanters[j].fullScaleG = before[j].fullScaleG;
    }
    return layout;
}

Result<LayoutDescription> findLayout(const std::string& nameOrPath) {
    EnchanterLayout preset;
    return layoutPreset(nameOrPath, preset) ? describeLayout(nameOrPath, preset) : loadLayout(nameOrPath);
}

Result<LayoutDescription> readLayout(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxLayoutFileBytes,
                    [](const Json& root) { return readLayoutFields(JsonField(root, {})); });
}

Result<LayoutDescription> loadLayout(const std::filesystem::path& path) {
    return loadText(path, limits::maxLayoutFileBytes, readLayout);
}

std::string layoutJson(const LayoutDescription& layout) {
    std::string text = "{\n  \"name\": " + jsonText(layout.name) + ",\n  \"extent_m\": [" +
                       jsonNumber(layout.geometry.extentWidthMetres) + ", " +
                       jsonNumber(layout.geometry.extentHeightMetres) + "],\n  \"enchanters\": [\n";
    for (std::size_t j = 0; j < layout.enchanters.size(); ++j) {
        text += enchanterJson(layout.enchanters[j], layout.geometry.places[j]);
        text += j + 1 < layout.enchanters.size() ? ",\n" : "\n";
    }
    return text + "  ]\n}\n";
}

} // namespace physvib
