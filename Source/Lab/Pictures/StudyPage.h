// SPDX-License-Identifier: MIT
// The page that all study pictures share: title, panels in rows, watermark, footer, PNG.
#pragma once
#include "Lab/Pictures/StudyPictures.h"
#include "Pictures/PictureCanvas.h"
#include <cstddef>
#include <functional>
#include <string>

namespace physvib::picture {

/// `count` panels of that height, `acrossMost` side by side, drawn one after the other into what is inside
/// them.
struct StudyPage {
    std::string title;
    std::string subtitle;
    std::size_t count = 1;
    std::size_t acrossMost = 1;
    int panelHeight = 400;
    std::function<void(const Canvas& canvas, std::size_t panel, Area inside)> draw;
};

/// The page as a PNG, 1600 pixels wide.
std::string studyPagePng(const StudyPage& page, const PictureWords& words);

/// From the ground of a well to the accent, for a share from 0 to 1; small shares still show.
Colour shareColour(double share);

/// A horizontal bar with its interval (both 0 to 1) in `row`, a name at its left and words at its right; it
/// begins at `from`.
void drawBar(const Canvas& canvas, Area row, int nameWidth, std::string_view name, double share, double least,
             double most, std::string_view value, Colour colour, double from = 0.0);

} // namespace physvib::picture
