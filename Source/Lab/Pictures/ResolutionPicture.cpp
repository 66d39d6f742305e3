// SPDX-License-Identifier: MIT
// From ellipses over the map of the likeliest targets to the merged grid.
#include "Lab/Pictures/StudyPage.h"
#include <algorithm>
#include <cmath>
#include <numeric>

namespace physvib {
namespace {

using namespace picture;

/// Neighbours differ: columns by hue, rows by lightness.
Colour targetColour(std::size_t target, std::size_t columns, std::size_t rows) {
    const auto hue = static_cast<float>(target % columns) / static_cast<float>(columns);
    const auto row =
        static_cast<float>(target / columns) / static_cast<float>(std::max<std::size_t>(rows, 2) - 1);
    return Colour::ofHue(hue, 0.45f, target / columns % 2 ? 0.36f + 0.1f * row : 0.56f + 0.1f * row);
}

Path ellipseOf(const PlaceNormal& n, const Area& field) {
    Path path;
    const double mean = 0.5 * (n.varianceX + n.varianceY),
                 spread = std::hypot(0.5 * (n.varianceX - n.varianceY), n.covariance);
    const double angle = 0.5 * std::atan2(2.0 * n.covariance, n.varianceX - n.varianceY);
    const auto a = static_cast<float>(std::sqrt(mean + spread)),
               b = static_cast<float>(std::sqrt(std::max(0.0, mean - spread)));
    path.addEllipse(-a, -b, 2.0f * a, 2.0f * b);
    path.move(Transform::rotation(static_cast<float>(angle))
                  .translated(static_cast<float>(n.meanX), static_cast<float>(n.meanY))
                  .scaled(static_cast<float>(field.width), static_cast<float>(field.height))
                  .translated(static_cast<float>(field.x), static_cast<float>(field.y)));
    return path;
}

void drawNormals(const Canvas& canvas, const ResponseNormals& made, const Area& field) {
    canvas.well(field);
    const Painter::Saved state(canvas.graphics);
    canvas.graphics.reduceClip(field);
    for (std::size_t i = 0; i < made.normals.size(); ++i) {
        const PlaceNormal& n = made.normals[i];
        if (n.responses == 0) continue;
        const auto colour = targetColour(i, made.columns, made.rows);
        const auto path = ellipseOf(n, field);
        canvas.graphics.setColour(colour.withAlpha(0.16f));
        canvas.graphics.fillPath(path);
        canvas.graphics.setColour(colour);
        canvas.graphics.strokePath(path, 1.5f);
        canvas.graphics.fillEllipse({static_cast<float>(field.x + n.meanX * field.width) - 2.5f,
                                     static_cast<float>(field.y + n.meanY * field.height) - 2.5f, 5.0f,
                                     5.0f});
    }
}

// Every pixel has the colour of the place under its middle.
void drawMap(const Canvas& canvas, const ConditionResolution& made, const Area& field) {
    for (int y = 0; y < field.height; ++y)
        for (int x = 0; x < field.width; ++x) {
            const auto column = (2 * static_cast<std::size_t>(x) + 1) * mapColumns /
                                (2 * static_cast<std::size_t>(field.width));
            const auto row = (2 * static_cast<std::size_t>(y) + 1) * mapRows /
                             (2 * static_cast<std::size_t>(field.height));
            canvas.graphics.blend(
                field.x + x, field.y + y,
                targetColour(made.map[row * mapColumns + column], made.normals.columns, made.normals.rows));
        }
}

Box cellOf(const Area& field, const PercentCounts& counts, std::size_t column, std::size_t row,
           std::size_t columns, std::size_t rows) {
    const float w = static_cast<float>(field.width) / static_cast<float>(counts.columns),
                h = static_cast<float>(field.height) / static_cast<float>(counts.rows);
    return {static_cast<float>(field.x) + w * static_cast<float>(column),
            static_cast<float>(field.y) + h * static_cast<float>(row), w * static_cast<float>(columns),
            h * static_cast<float>(rows)};
}

void drawGrid(const Canvas& canvas, const ConditionResolution& made, const Area& field) {
    const PercentCounts& counts = made.counts;
    const double most = *std::ranges::max_element(counts.percent);
    for (std::size_t r = 0; r < counts.rows; ++r)
        for (std::size_t c = 0; c < counts.columns; ++c) {
            const auto cell = cellOf(field, counts, c, r, 1, 1);
            canvas.graphics.setColour(shareColour(0.5 * counts.at(r, c) / std::max(most, 1e-9)));
            canvas.graphics.fillRect(cell.reduced(1.0f));
            canvas.text(number(counts.at(r, c), 2), cell.rounded(), Align::centre, palette::text,
                        std::min(smallText, cell.height - 2.0f));
        }
    if (made.resolution.ties.empty()) return;
    canvas.graphics.setColour(palette::text);
    const GridMerge& merge = made.resolution.ties.front();
    for (std::size_t r = 0, row = 0; r < merge.rowGroups.size(); row += merge.rowGroups[r++])
        for (std::size_t c = 0, column = 0; c < merge.columnGroups.size(); column += merge.columnGroups[c++])
            canvas.graphics.drawRounded(
                cellOf(field, counts, column, row, merge.columnGroups[c], merge.rowGroups[r]).reduced(1.5f),
                4.0f, 2.0f);
}

std::string remarkOf(const ConditionResolution& made) {
    const auto& resolution = made.resolution;
    std::string words = std::to_string(static_cast<int>(resolution.columns)) + " x " +
                        std::to_string(static_cast<int>(resolution.rows)) + " places can be told apart";
    if (resolution.ties.size() > 1)
        words += ", " + std::to_string(static_cast<int>(resolution.ties.size())) + " merges tie";
    return words;
}

void drawCondition(const Canvas& canvas, const ConditionResolution& made, Area inside) {
    canvas.heading(cleanLine(made.condition), remarkOf(made), inside.removeFromTop(24));
    inside.removeFromTop(6);
    Area captions = inside.removeFromBottom(24);
    const bool hasMap = !made.map.empty();
    const int space = 18, part = hasMap ? (inside.width - 2 * space) / 3 : inside.width;
    const auto next = [&](const char* caption) {
        canvas.text(caption, captions.removeFromLeft(part), Align::centre, palette::muted);
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
    StudyPage page{"Perceptual resolution",
                   hasMaps ? "where each target was felt, and how finely places can be told apart"
                           : "how finely places can be told apart",
                   conditions.size(),
                   hasMaps ? 1u : 2u,
                   hasMaps ? 336 : 400,
                   {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        drawCondition(canvas, conditions[i], inside);
    };
    return studyPagePng(page, words);
}

} // namespace physvib
