// SPDX-License-Identifier: MIT
// Draws the lane of impacts: stems, their scale, and the legend of their colours.
#include "Pictures/PictureParts.h"
#include "Scene/World/SceneCast.h"
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <set>
#include <span>

namespace physvib::picture {
namespace {

constexpr double floorDecibels = -60.0;
constexpr std::ptrdiff_t mostDots = 600; // more heads of stems hide each other
constexpr int headRoom = 6;

/// Amplitude to height: floorDecibels at the bottom, 0 dBFS or the next ten above the strongest at the top.
struct LevelAxis {
    double ceiling;
    Area lane;
    float height(double level) const {
        const double share = (level - floorDecibels) / (ceiling - floorDecibels);
        return static_cast<float>(std::max(share * (lane.height - headRoom), 2.0)); // the quietest shows
    }
};

std::vector<const CollisionEvent*> loudestFirst(std::span<const CollisionEvent> events) {
    std::vector<const CollisionEvent*> order;
    for (const auto& event : events) order.push_back(&event);
    std::ranges::stable_sort(order, std::greater{}, [](const auto* e) { return std::abs(e->amplitude); });
    return order;
}

void drawStem(const Canvas& canvas, float x, float bottom, float height, Colour colour, bool dot) {
    canvas.graphics.setColour(dot ? colour.withAlpha(0.75f) : colour);
    canvas.graphics.fillRect({dot ? x - 0.75f : std::floor(x), bottom - height, dot ? 1.5f : 1.0f, height});
    canvas.graphics.setColour(colour);
    if (dot) canvas.graphics.fillEllipse({x - 2.5f, bottom - height - 2.5f, 5.0f, 5.0f});
}

void drawLevelLabels(const Canvas& canvas, const LevelAxis& levels) {
    const Area lane = levels.lane;
    for (const double level : {0.0, -20.0, -40.0, -60.0}) {
        const int y = lane.bottom() - roundToInt(levels.height(level));
        const Area row{lane.x - 60, std::clamp(y - 9, lane.y - 4, lane.bottom() - 16), 52, 18};
        canvas.text(number(level, 0), row, Align::right, palette::muted);
    }
}

int entryWidth(const Canvas& canvas, const HitColours::Class& c) {
    return canvas.textWidth(c.name, smallText) + 40;
}

} // namespace

// Strong ones first, so that weaker stems at the same pixel stand before them; the strongest again on top.
void drawHits(const Canvas& canvas, const PictureInput& input, const HitColours& colours, const Axis& axis) {
    const auto order = loudestFirst(input.events);
    const double loudest = order.empty() ? 0.0 : decibels(order.front()->amplitude);
    const LevelAxis levels{std::max(0.0, 10.0 * std::ceil(loudest / 10.0)), axis.lane};
    drawLevelLabels(canvas, levels);
    if (order.empty()) return canvas.text("no hits", axis.lane, Align::centre, palette::muted);
    const auto draw = [&](const CollisionEvent& event, Colour colour, bool dot) {
        const double seconds = static_cast<double>(event.timeNs) * 1e-9;
        if (seconds < axis.from || seconds > axis.to) return;
        drawStem(canvas, axis.x(seconds), static_cast<float>(axis.lane.bottom()),
                 levels.height(decibels(event.amplitude)), colour, dot);
    };
    const bool hasDots = std::ranges::count_if(input.events, isHit) <= mostDots;
    for (const auto* event : order)
        draw(*event, colours.of(*event), hasDots && isHit(*event)); // grains are a lawn
    draw(*order.front(), palette::now, true);
}

void drawLegend(const Canvas& canvas, const HitColours& colours, Area row) {
    int width = -20; // nothing behind the last
    for (const auto& c : colours.classes()) width += entryWidth(canvas, c);
    const int share = row.width / std::max(static_cast<int>(colours.classes().size()), 1);
    const bool fits = width <= row.width;
    if (fits) row = row.withLeft(row.right() - width);
    for (const auto& c : colours.classes()) {
        Area entry = row.removeFromLeft(fits ? entryWidth(canvas, c) : share);
        canvas.graphics.setColour(c.colour);
        canvas.graphics.fillEllipse(entry.removeFromLeft(18).withSizeKeepingCentre(11, 11).toFloat());
        canvas.text(c.name, fits ? entry : entry.withTrimmedRight(10), Align::left, palette::muted);
    }
}

namespace {

constexpr double anyDecay = -1.0;
constexpr double endless = std::numeric_limits<double>::infinity();

bool sounds(const Material& material, const CollisionEvent& event) {
    return material.frequencyHz == event.frequencyHz && material.decayPerSecond == event.decayPerSecond;
}

} // namespace

HitColours::HitColours(const PictureInput& input) {
    if (input.scene != nullptr && input.scene->materials.size() <= palette::materialCount)
        takeMaterials(input);
    else if (!takeParts(input))
        takeFrequencies(input);
    if (!input.events.empty()) classes_.push_back({"strongest", palette::now});
}

Colour HitColours::of(const CollisionEvent& event) const {
    for (const auto& rule : rules_)
        if ((rule.part == 0 || rule.part == event.source.part) && event.frequencyHz >= rule.lowestHz &&
            event.frequencyHz <= rule.highestHz &&
            (rule.decayPerSecond == anyDecay || rule.decayPerSecond == event.decayPerSecond))
            return rule.colour;
    return palette::other;
}

// (f, tau) tells the material, whichever of the two bodies gave its voice to the hit.
void HitColours::takeMaterials(const PictureInput& input) {
    meaning_ = "material";
    const auto& materials = input.scene->materials;
    bool unknown = false;
    std::set<std::size_t> used;
    for (const auto& body : sceneCast(*input.scene))
        for (const auto& fixture : body.fixtures) used.insert(static_cast<std::size_t>(fixture.material));
    for (const auto& event : input.events) {
        const auto found = std::ranges::find_if(materials, [&](const auto& m) { return sounds(m, event); });
        found == materials.end() ? void(unknown = true)
                                 : void(used.insert(static_cast<std::size_t>(found - materials.begin())));
    }
    for (const auto index : used) {
        if (index >= materials.size()) continue;
        const auto& m = materials[index];
        const auto colour = palette::materialOf(materials, static_cast<int>(index));
        rules_.push_back({m.frequencyHz, m.frequencyHz, m.decayPerSecond, colour});
        const auto name = cleanLine(m.name);
        classes_.push_back(
            {m.frequencyHz > 0.0 ? name + " " + shortNumber(m.frequencyHz) + " Hz" : name, colour});
    }
    if (unknown) classes_.push_back({"other", palette::other});
}

bool HitColours::takeParts(const PictureInput& input) {
    const std::span places{input.layout.places.data(), static_cast<std::size_t>(input.layout.count)};
    const auto channelOf = [&](PartNumber part) {
        return static_cast<int>(std::ranges::find(places, part, &ActuatorPlace::part) - places.begin());
    };
    std::set<int> channels; // the first of each part
    for (const auto& event : input.events) {
        const int channel = event.source.part == 0 ? input.layout.count : channelOf(event.source.part);
        if (channel == input.layout.count) return false;
        channels.insert(channel);
    }
    for (const int channel : channels) {
        const PartNumber part = places[static_cast<std::size_t>(channel)].part;
        const auto name = builtInPart(part);
        rules_.push_back({0.0, endless, anyDecay, palette::enchanter(channel), part});
        classes_.push_back(
            {name.empty() ? labelOf(input, channel) : std::string{name}, palette::enchanter(channel)});
    }
    if (!channels.empty()) meaning_ = "part of the body";
    return !channels.empty();
}

void HitColours::takeFrequencies(const PictureInput& input) {
    std::set<double> heard;
    for (const auto& event : input.events) {
        heard.insert(event.frequencyHz);
        if (heard.size() > palette::rampCount) break;
    }
    if (heard.size() <= palette::rampCount) {
        for (int i = 0; const double f : heard) {
            rules_.push_back({f, f, anyDecay, palette::ramp(i)});
            classes_.push_back({shortNumber(f) + " Hz", palette::ramp(i++)});
        }
        return;
    }
    const std::string to = "\xe2\x80\x93";
    constexpr double edges[] = {0.0, 50.0, 100.0, 200.0, 400.0, 800.0, endless}; // octaves of touch
    for (int i = 0; i < palette::rampCount; ++i) {
        rules_.push_back({edges[i], edges[i + 1], anyDecay, palette::ramp(i)});
        const auto name = i == 0                    ? "up to " + shortNumber(edges[1])
                          : edges[i + 1] == endless ? "above " + shortNumber(edges[i])
                                                    : shortNumber(edges[i]) + to + shortNumber(edges[i + 1]);
        classes_.push_back({name + " Hz", palette::ramp(i)});
    }
}

} // namespace physvib::picture
