// SPDX-License-Identifier: MIT
// Draws the lane of impacts: stems, their scale, and the legend of their colours.
#include "Pictures/PictureParts.h"
#include <algorithm>
#include <cmath>
#include <functional>

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
        return static_cast<float>(std::max(share * (lane.height - headRoom), 2.0)); // the quietest still
                                                                                    // shows
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

} // namespace physvib::picture
