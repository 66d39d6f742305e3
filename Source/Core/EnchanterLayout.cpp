// SPDX-License-Identifier: MIT
// The preset layouts PHONE and RING with 1 to 4 enchanters, and what makes any layout usable.
#include "Core/EnchanterLayout.h"
#include <cmath>
#include <cstddef>

namespace physvib {
namespace {

// The thesis gives no coordinates: enchanters on the back of a phone of about 138 x 69 mm, and fingers of two
// hands that hold one in landscape grip.
constexpr std::array<EnchanterPlace, 2> presetExtents{{{0.12, 0.06}, {0.16, 0.08}}};
constexpr std::size_t largestPreset = 4;

using Places = std::array<EnchanterPlace, largestPreset>;

// Shares of the extent, for 1, 2, 3 and 4 enchanters.
constexpr std::array<Places, largestPreset> presetPlaces{{
    {{{0.5, 0.5}}},
    {{{0.0, 0.5}, {1.0, 0.5}}},
    {{{0.0, 1.0}, {1.0, 1.0}, {0.5, 0.0}}},
    {{{0.0, 1.0}, {1.0, 1.0}, {0.0, 0.0}, {1.0, 0.0}}},
}};
static_assert(layoutPresetNames.size() == presetExtents.size() * largestPreset);

EnchanterLayout makePreset(std::size_t index) noexcept {
    const EnchanterPlace extent = presetExtents[index / largestPreset];
    const std::size_t last = index % largestPreset;
    EnchanterLayout layout{extent.xMetres, extent.yMetres, static_cast<int>(last + 1), {}};
    for (std::size_t j = 0; j <= last; ++j) {
        const EnchanterPlace share = presetPlaces[last][j];
        layout.places[j] = {share.xMetres * extent.xMetres, share.yMetres * extent.yMetres};
    }
    return layout;
}

bool isPositive(double metres) noexcept {
    return std::isfinite(metres) && metres > 0.0;
}

} // namespace

bool isValid(const EnchanterLayout& layout) noexcept {
    if (layout.count < 1 || layout.count > limits::maxEnchanters) return false;
    for (std::size_t j = 0; j < static_cast<std::size_t>(layout.count); ++j)
        if (!std::isfinite(layout.places[j].xMetres) || !std::isfinite(layout.places[j].yMetres))
            return false;
    return isPositive(layout.extentWidthMetres) && isPositive(layout.extentHeightMetres);
}

bool layoutPreset(std::string_view name, EnchanterLayout& layout) noexcept {
    for (std::size_t i = 0; i < layoutPresetNames.size(); ++i) {
        if (layoutPresetNames[i] != name) continue;
        layout = makePreset(i);
        return true;
    }
    return false;
}

} // namespace physvib
