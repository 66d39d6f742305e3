// SPDX-License-Identifier: GPL-3.0-or-later
// Forced choices and ratings as bars.
#include "Host/StudyPage.h"
#include <algorithm>

namespace physvib {
namespace {

using namespace picture;

constexpr int rowHeight = 26, headHeight = 64;

int nameWidth(auto&& summaries) {
    int width = 60;
    for (const auto& summary : summaries) width = std::max(width, textWidth(wordsOf(summary.condition), smallText) + 20);
    return std::min(width, 460);
}

} // namespace

std::string choicePicture(std::span<const ChoiceSummary> summaries, const PictureWords& words) {
    const auto& shares = summaries.front().shares;
    StudyPage page{"Forced choices", "shares with 95 % intervals", shares.size(), 2, headHeight + rowHeight * static_cast<int>(summaries.size()), {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        canvas.heading(wordsOf(shares[i].alternative), "chosen, % of trials", inside.removeFromTop(24));
        inside.removeFromTop(8);
        const int names = nameWidth(summaries);
        for (const auto& summary : summaries) {
            const Proportion& votes = summary.shares[i].votes;
            drawBar(canvas, inside.removeFromTop(rowHeight), names, wordsOf(summary.condition), votes.share, votes.least, votes.most,
                    number(100.0 * votes.share, 1) + " %", palette::enchanter(static_cast<int>(i)));
        }
    };
    return studyPagePng(page, words);
}

std::string ratingPicture(const std::vector<std::string>& scales, std::span<const RatingSummary> summaries, const PictureWords& words) {
    StudyPage page{"Ratings", "means from 0 to 100 with 95 % intervals", scales.size(), 3, headHeight + rowHeight * static_cast<int>(summaries.size()), {}};
    page.draw = [&](const Canvas& canvas, std::size_t i, Area inside) {
        canvas.heading(wordsOf(scales[i]), "", inside.removeFromTop(24));
        inside.removeFromTop(8);
        const int names = std::min(nameWidth(summaries), inside.getWidth() / 3);
        for (const auto& summary : summaries) {
            const double mean = 0.01 * summary.means[i], half = 0.01 * summary.halfIntervals[i];
            drawBar(canvas, inside.removeFromTop(rowHeight), names, wordsOf(summary.condition), mean, std::max(0.0, mean - half), half > 0.0 ? std::min(1.0, mean + half) : 0.0,
                    number(summary.means[i], 1), palette::enchanter(static_cast<int>(i)));
        }
    };
    return studyPagePng(page, words);
}

} // namespace physvib
