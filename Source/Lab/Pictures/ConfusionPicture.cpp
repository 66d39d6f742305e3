// SPDX-License-Identifier: MIT
// Confusion matrices as squares of light, and the icons chosen from them.
#include "Lab/Pictures/StudyPage.h"
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

using namespace picture;

constexpr std::size_t mostLabels = 36; // more do not fit beside the rows
constexpr int labelWidth = 64;

std::string summaryOf(const ConfusionPanel& panel) {
    const auto& it = panel.transfer;
    const double correct =
        100.0 * static_cast<double>(panel.matrix.correct()) / static_cast<double>(panel.matrix.trials());
    return number(correct, 1) + " % correct of " + number(static_cast<double>(panel.matrix.trials()), 0) +
           ", IT " + number(it.bits, 2) + " bit" +
           (it.canBeCorrected() ? ", corrected " + number(it.correctedBits(), 2)
                                : ", at least " + number(it.leastBits, 2));
}

void drawLabels(const Canvas& canvas, const ConfusionMatrix& matrix, const Area& square, float cell) {
    const float height = std::clamp(cell - 2.0f, 8.0f, smallText);
    for (std::size_t i = 0; i < matrix.responses(); ++i) {
        const int at = roundToInt(static_cast<float>(i) * cell), size = std::max(roundToInt(cell), 10);
        const auto words = cleanLine(matrix.label(i));
        if (i < matrix.stimuli())
            canvas.text(words, {square.x - labelWidth, square.y + at, labelWidth - 6, size}, Align::right,
                        palette::muted, height);
        Painter& g = canvas.graphics;
        const Painter::Saved state(g);
        const auto x = static_cast<float>(square.x + at) + 0.5f * cell;
        const auto y = static_cast<float>(square.bottom() + 6);
        g.addTransform(Transform::rotation(-0.5f * std::numbers::pi_v<float>, x, y));
        canvas.text(words, {roundToInt(x) - labelWidth, roundToInt(y) - size / 2, labelWidth, size},
                    Align::right, palette::muted, height);
    }
}

void drawCells(const Canvas& canvas, const ConfusionMatrix& matrix, const Area& square, float cell) {
    const auto totals = matrix.stimulusTotals();
    const float space = cell > 6.0f ? 1.0f : 0.0f;
    for (std::size_t i = 0; i < matrix.stimuli(); ++i)
        for (std::size_t j = 0; j < matrix.responses(); ++j) {
            if (matrix.count(i, j) == 0) continue;
            canvas.graphics.setColour(shareColour(matrix.count(i, j) / static_cast<double>(totals[i])));
            canvas.graphics.fillRect({static_cast<float>(square.x) + static_cast<float>(j) * cell,
                                      static_cast<float>(square.y) + static_cast<float>(i) * cell,
                                      cell - space, cell - space});
        }
}

void drawMatrix(const Canvas& canvas, const ConfusionPanel& panel, Area inside) {
    canvas.heading(cleanLine(panel.title), summaryOf(panel), inside.removeFromTop(24));
    inside.removeFromTop(8);
    const bool hasLabels = panel.matrix.responses() <= mostLabels;
    Area room = inside.withTrimmedLeft(labelWidth + 30).withTrimmedBottom(hasLabels ? labelWidth + 26 : 30);
    const auto most = static_cast<float>(std::max(panel.matrix.responses(), panel.matrix.stimuli()));
    const float cell = static_cast<float>(std::min(room.width, room.height)) / most;
    const Area square(room.x +
                          (room.width - roundToInt(cell * static_cast<float>(panel.matrix.responses()))) / 2,
                      room.y, roundToInt(cell * static_cast<float>(panel.matrix.responses())),
                      roundToInt(cell * static_cast<float>(panel.matrix.stimuli())));
    canvas.well(square);
    drawCells(canvas, panel.matrix, square, cell);
    if (hasLabels) drawLabels(canvas, panel.matrix, square, cell);
    canvas.text("response", {square.x, square.bottom() + (hasLabels ? labelWidth + 6 : 6), square.width, 20},
                Align::centre, palette::text);
    const Painter::Saved state(canvas.graphics);
    const int x = square.x - (hasLabels ? labelWidth + 14 : 14);
    canvas.graphics.addTransform(Transform::rotation(-0.5f * std::numbers::pi_v<float>, static_cast<float>(x),
                                                     static_cast<float>(square.centre().y)));
    canvas.text("stimulus", {x - 100, square.y + square.height / 2 - 10, 200, 20}, Align::centre,
                palette::text);
}

} // namespace

std::string confusionPicture(std::span<const ConfusionPanel> panels, const PictureWords& words) {
    StudyPage page{"Confusion",   "brightness: share of a stimulus' trials that got the response",
                   panels.size(), 2,
                   760,           {}};
    if (panels.size() == 1) page.panelHeight = 900;
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        drawMatrix(canvas, panels[i], inside);
    };
    return studyPagePng(page, words);
}

std::string iconPicture(std::span<const IconPanel> panels, const PictureWords& words) {
    std::size_t most = 0;
    for (const auto& panel : panels) most = std::max(most, panel.icons.size());
    StudyPage page{"Tactile icons",
                   "the stimuli that are confused least, and how often each was identified",
                   panels.size(),
                   1,
                   60 + 24 * static_cast<int>(most),
                   {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        canvas.heading(cleanLine(panels[i].title),
                       number(static_cast<double>(panels[i].icons.size()), 0) + " meanings",
                       inside.removeFromTop(24));
        inside.removeFromTop(8);
        for (const auto& icon : panels[i].icons)
            drawBar(canvas, inside.removeFromTop(24), 140, cleanLine(icon.label), icon.shareCorrect, 0.0, 0.0,
                    number(100.0 * icon.shareCorrect, 1) + " %", palette::enchanter(0));
    };
    return studyPagePng(page, words);
}

} // namespace physvib
