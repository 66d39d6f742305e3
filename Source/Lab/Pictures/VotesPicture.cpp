// SPDX-License-Identifier: MIT
// Forced choices, ratings and levels as bars.
#include "Lab/Pictures/StudyPage.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using namespace picture;

constexpr int rowHeight = 26, headHeight = 64;

int nameWidth(const Canvas& canvas, auto&& summaries) {
    int width = 60;
    for (const auto& summary : summaries)
        width = std::max(width, canvas.textWidth(cleanLine(summary.condition), smallText) + 20);
    return std::min(width, 460);
}

/// Parts of the level picture: a kind, and what belongs to it.
struct LevelPanel {
    LevelTrial::Kind kind;
    std::string title, remark;
    std::vector<const LevelSummary*> rows;
};

std::vector<LevelPanel> levelPanels(std::span<const LevelSummary> summaries) {
    using Kind = LevelTrial::Kind;
    std::vector<LevelPanel> panels{{Kind::staircase, "Thresholds", "dB, mean of the later reversals", {}},
                                   {Kind::adjustment, "Matched levels", "dB, zero in the middle", {}},
                                   {Kind::magnitude, "Magnitudes", "geometric means", {}},
                                   {Kind::quest, "Thresholds", "dB, by QUEST+", {}}};
    for (const auto& s : summaries) panels[static_cast<std::size_t>(s.kind)].rows.push_back(&s);
    std::erase_if(panels, [](const auto& p) { return p.rows.empty(); });
    return panels;
}

void drawLevels(const Canvas& canvas, const LevelPanel& panel, Area& inside) {
    canvas.heading(panel.title, panel.remark, inside.removeFromTop(24));
    inside.removeFromTop(8);
    double most = 1e-9;
    for (const auto* s : panel.rows)
        most = std::max(most, 1.1 * (std::abs(s->estimate) +
                                     (panel.kind == LevelTrial::Kind::magnitude ? 0.0 : s->deviation)));
    const bool isSigned = panel.kind == LevelTrial::Kind::adjustment;
    const auto share = [&](double value) {
        return std::clamp(isSigned ? 0.5 + 0.5 * value / most : value / most, 0.0, 1.0);
    };
    for (const auto* s : panel.rows) {
        const double half = panel.kind == LevelTrial::Kind::magnitude ? 0.0 : s->deviation;
        drawBar(canvas, inside.removeFromTop(rowHeight), 400,
                cleanLine(s->condition + (s->stimulus.empty() ? "" : ", " + s->stimulus)), share(s->estimate),
                share(s->estimate - half), half > 0.0 ? share(s->estimate + half) : 0.0,
                number(s->estimate, 1), palette::enchanter(static_cast<int>(panel.kind)), share(0.0));
    }
}

} // namespace

std::string levelPicture(std::span<const LevelSummary> summaries, const PictureWords& words) {
    const auto panels = levelPanels(summaries);
    int height = 24;
    for (const auto& panel : panels) height += headHeight + rowHeight * static_cast<int>(panel.rows.size());
    StudyPage page{"Levels", "lines: one standard deviation", 1, 1, height, {}};
    page.draw = [&](const Canvas& canvas, std::size_t, Area inside) {
        for (const auto& panel : panels) {
            drawLevels(canvas, panel, inside);
            inside.removeFromTop(headHeight - 32);
        }
    };
    return studyPagePng(page, words);
}

std::string choicePicture(std::span<const ChoiceSummary> summaries, const PictureWords& words) {
    const auto& shares = summaries.front().shares;
    StudyPage page{"Forced choices",
                   "mean shares with 95 % intervals over participants",
                   shares.size(),
                   2,
                   headHeight + rowHeight * static_cast<int>(summaries.size()),
                   {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        canvas.heading(cleanLine(shares[i].alternative), "chosen, %", inside.removeFromTop(24));
        inside.removeFromTop(8);
        const int names = nameWidth(canvas, summaries);
        for (const auto& summary : summaries) {
            const ChoiceShare& votes = summary.shares[i];
            drawBar(canvas, inside.removeFromTop(rowHeight), names, cleanLine(summary.condition), votes.share,
                    votes.least, votes.most, number(100.0 * votes.share, 1) + " %",
                    palette::enchanter(static_cast<int>(i)));
        }
    };
    return studyPagePng(page, words);
}

std::string ratingPicture(const std::vector<std::string>& scales, std::span<const RatingSummary> summaries,
                          const PictureWords& words) {
    StudyPage page{"Ratings",
                   "means from 0 to 100 with 95 % intervals",
                   scales.size(),
                   3,
                   headHeight + rowHeight * static_cast<int>(summaries.size()),
                   {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        canvas.heading(cleanLine(scales[i]), "", inside.removeFromTop(24));
        inside.removeFromTop(8);
        const int names = std::min(nameWidth(canvas, summaries), inside.width / 3);
        for (const auto& summary : summaries) {
            const double mean = 0.01 * summary.means[i], half = 0.01 * summary.halfIntervals[i];
            drawBar(canvas, inside.removeFromTop(rowHeight), names, cleanLine(summary.condition), mean,
                    std::max(0.0, mean - half), half > 0.0 ? std::min(1.0, mean + half) : 0.0,
                    number(summary.means[i], 1), palette::enchanter(static_cast<int>(i)));
        }
    };
    return studyPagePng(page, words);
}

} // namespace physvib
