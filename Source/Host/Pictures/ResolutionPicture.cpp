// SPDX-License-Identifier: GPL-3.0-or-later
// From ellipses over the map of the likeliest targets to the merged grid.
#include "Host/Pictures/StudyPage.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

using namespace picture;
using J = juce::Justification;

/// Neighbours differ: columns by hue, rows by lightness.
juce::Colour targetColour(std::size_t target, std::size_t columns, std::size_t rows) {
    const auto hue = static_cast<float>(target % columns) / static_cast<float>(columns);
    const auto row = static_cast<float>(target / columns) / static_cast<float>(std::max<std::size_t>(rows, 2) - 1);
    return juce::Colour::fromHSL(hue, 0.45f, target / columns % 2 ? 0.36f + 0.1f * row : 0.56f + 0.1f * row, 1.0f);
}

juce::Path ellipseOf(const PlaceNormal& n, const Area& field) {
    juce::Path path;
    const double mean = 0.5 * (n.varianceX + n.varianceY), spread = std::hypot(0.5 * (n.varianceX - n.varianceY), n.covariance);
    const double angle = 0.5 * std::atan2(2.0 * n.covariance, n.varianceX - n.varianceY);
    const auto a = static_cast<float>(std::sqrt(mean + spread)), b = static_cast<float>(std::sqrt(std::max(0.0, mean - spread)));
    path.addEllipse(-a, -b, 2.0f * a, 2.0f * b);
    path.applyTransform(juce::AffineTransform::rotation(static_cast<float>(angle))
                            .translated(static_cast<float>(n.meanX), static_cast<float>(n.meanY))
                            .scaled(static_cast<float>(field.getWidth()), static_cast<float>(field.getHeight()))
                            .translated(static_cast<float>(field.getX()), static_cast<float>(field.getY())));
    return path;
}

void drawNormals(const Canvas& canvas, const ResponseNormals& made, const Area& field) {
    canvas.well(field);
    const juce::Graphics::ScopedSaveState state(canvas.graphics);
    canvas.graphics.reduceClipRegion(field);
    for (std::size_t i = 0; i < made.normals.size(); ++i) {
        const PlaceNormal& n = made.normals[i];
        if (n.responses == 0) continue;
        const auto colour = targetColour(i, made.columns, made.rows);
        const auto path = ellipseOf(n, field);
        canvas.graphics.setColour(colour.withAlpha(0.16f));
        canvas.graphics.fillPath(path);
        canvas.graphics.setColour(colour);
        canvas.graphics.strokePath(path, juce::PathStrokeType(1.5f));
        canvas.graphics.fillEllipse(static_cast<float>(field.getX() + n.meanX * field.getWidth()) - 2.5f,
                                    static_cast<float>(field.getY() + n.meanY * field.getHeight()) - 2.5f, 5.0f, 5.0f);
    }
}

void drawMap(const Canvas& canvas, const ConditionResolution& made, const Area& field) {
    constexpr int w = static_cast<int>(mapColumns), h = static_cast<int>(mapRows);
    juce::Image image(juce::Image::RGB, w, h, false, juce::SoftwareImageType());
    {
        juce::Image::BitmapData pixels(image, juce::Image::BitmapData::writeOnly);
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                pixels.setPixelColour(x, y, targetColour(made.map[static_cast<std::size_t>(y) * mapColumns + static_cast<std::size_t>(x)], made.normals.columns, made.normals.rows));
    }
    canvas.graphics.setImageResamplingQuality(juce::Graphics::highResamplingQuality);
    canvas.graphics.drawImage(image, field.toFloat());
}

juce::Rectangle<float> cellOf(const Area& field, const PercentCounts& counts, std::size_t column, std::size_t row, std::size_t columns, std::size_t rows) {
    const float w = static_cast<float>(field.getWidth()) / static_cast<float>(counts.columns), h = static_cast<float>(field.getHeight()) / static_cast<float>(counts.rows);
    return {static_cast<float>(field.getX()) + w * static_cast<float>(column), static_cast<float>(field.getY()) + h * static_cast<float>(row),
            w * static_cast<float>(columns), h * static_cast<float>(rows)};
}

void drawGrid(const Canvas& canvas, const ConditionResolution& made, const Area& field) {
    const PercentCounts& counts = made.counts;
    const double most = *std::ranges::max_element(counts.percent);
    for (std::size_t r = 0; r < counts.rows; ++r)
        for (std::size_t c = 0; c < counts.columns; ++c) {
            const auto cell = cellOf(field, counts, c, r, 1, 1);
            canvas.graphics.setColour(shareColour(0.5 * counts.at(r, c) / std::max(most, 1e-9)));
            canvas.graphics.fillRect(cell.reduced(1.0f));
            canvas.text(number(counts.at(r, c), 2), cell.toNearestInt(), J::centred, palette::text, std::min(smallText, cell.getHeight() - 2.0f));
        }
    if (made.resolution.ties.empty()) return;
    canvas.graphics.setColour(palette::text);
    const GridMerge& merge = made.resolution.ties.front();
    for (std::size_t r = 0, row = 0; r < merge.rowGroups.size(); row += merge.rowGroups[r++])
        for (std::size_t c = 0, column = 0; c < merge.columnGroups.size(); column += merge.columnGroups[c++])
            canvas.graphics.drawRoundedRectangle(cellOf(field, counts, column, row, merge.columnGroups[c], merge.rowGroups[r]).reduced(1.5f), 4.0f, 2.0f);
}

juce::String remarkOf(const ConditionResolution& made) {
    const auto& resolution = made.resolution;
    juce::String words = juce::String(static_cast<int>(resolution.columns)) + " x " + juce::String(static_cast<int>(resolution.rows)) + " places can be told apart";
    if (resolution.ties.size() > 1) words += ", " + juce::String(static_cast<int>(resolution.ties.size())) + " merges tie";
    return words;
}

void drawCondition(const Canvas& canvas, const ConditionResolution& made, Area inside) {
    canvas.heading(wordsOf(made.condition), remarkOf(made), inside.removeFromTop(24));
    inside.removeFromTop(6);
    Area captions = inside.removeFromBottom(24);
    const bool hasMap = !made.map.empty();
    const int space = 18, part = hasMap ? (inside.getWidth() - 2 * space) / 3 : inside.getWidth();
    const auto next = [&](const char* caption) {
        canvas.text(caption, captions.removeFromLeft(part), J::centred, palette::muted);
        captions.removeFromLeft(space);
        const Area field = inside.removeFromLeft(part);
        inside.removeFromLeft(space);
        return field;
    };
    if (hasMap) drawNormals(canvas, made.normals, next("responses: means and one standard deviation"));
    if (hasMap) drawMap(canvas, made, next("likeliest target of every place"));
    drawGrid(canvas, made, next("percent counts, frames: the merged grid"));
}

} // namespace

std::string resolutionPicture(std::span<const ConditionResolution> conditions, const PictureWords& words) {
    const bool hasMaps = std::ranges::any_of(conditions, [](const auto& c) { return !c.map.empty(); });
    StudyPage page{"Perceptual resolution", hasMaps ? "where each target was felt, and how finely places can be told apart" : "how finely places can be told apart",
                   conditions.size(), hasMaps ? 1u : 2u, hasMaps ? 336 : 400, {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) { drawCondition(canvas, conditions[i], inside); };
    return studyPagePng(page, words);
}

} // namespace physvib
