// SPDX-License-Identifier: MIT
// Actuator places in both MPEG formats: points of a grid over the field.
#pragma once
#include "Formats/Clip.h"
#include "Formats/MpegNames.h"
#include <algorithm>
#include <cmath>

namespace physvib::mpeg {

struct GridPoint {
    int x = 0, y = 0;
};

/// A grid of whole millimetres over the clip's extent, as fine as the coordinates allow. Any thread.
struct PlaceGrid {
    explicit PlaceGrid(const Clip& clip) {
        const double longest = std::max(clip.extentWidthMetres, clip.extentHeightMetres);
        pitchMetres = 1e-3 * std::max(1.0, std::ceil(longest * 1e3 / (mostCoordinate - 1) - 1e-9));
        points = {pointsOf(clip.extentWidthMetres), pointsOf(clip.extentHeightMetres)};
    }
    GridPoint at(const EnchanterPlace& place) const {
        const auto index = [this](double metres, int count) {
            return static_cast<int>(
                std::clamp(std::lround(metres / pitchMetres), 0L, static_cast<long>(count - 1)));
        };
        return {index(place.xMetres, points.x), index(place.yMetres, points.y)};
    }
    double pitchMetres;
    GridPoint points; ///< along each side

private:
    int pointsOf(double metres) const { return static_cast<int>(std::lround(metres / pitchMetres)) + 1; }
};

/// Sets a channel's place in the clip, assuming a grid of 1 mm, because the format has no unit. A grid of one
/// point has no places. Any thread.
inline void takePlace(Clip& clip, ClipChannel& channel, GridPoint points, GridPoint at) {
    if (points.x < 1 || points.y < 1 || points.x + points.y < 3 || at.x < 0 || at.y < 0 || at.x >= points.x ||
        at.y >= points.y)
        return;
    channel.place = EnchanterPlace{1e-3 * at.x, 1e-3 * at.y};
    clip.extentWidthMetres = std::max(clip.extentWidthMetres, 1e-3 * std::max(1, points.x - 1));
    clip.extentHeightMetres = std::max(clip.extentHeightMetres, 1e-3 * std::max(1, points.y - 1));
}

} // namespace physvib::mpeg
