// SPDX-License-Identifier: MIT
// Positions of 1 to 64 actuators ("enchanter configuration" in the thesis, 3.2, 6.1).
#pragma once
#include "Core/Limits.h"
#include <array>
#include <span>
#include <string_view>

namespace physvib {

/// One actuator's place on the layout, metres from its lower left corner.
struct EnchanterPlace {
    double xMetres = 0.0; ///< from the left
    double yMetres = 0.0; ///< from below
};

/// Places of the actuators, in channel order. The field of the world is mapped onto `extent`.
struct EnchanterLayout {
    double extentWidthMetres = 0.0;  ///< above 0
    double extentHeightMetres = 0.0; ///< above 0
    int count = 0;                   ///< 1 to limits::maxEnchanters; channel j is places[j]
    std::array<EnchanterPlace, limits::maxEnchanters> places{}; ///< the first `count` are used
};

/// True if the layout can be panned over: count in range, extent positive, everything finite. Any thread.
bool isValid(const EnchanterLayout& layout) noexcept;

/// Names of the presets, in the order of the table in EnchanterLayout.cpp.
extern const std::span<const std::string_view> layoutPresetNames;

/// Fills `layout` with the preset of that name; false (and `layout` unchanged) if there is none. Any thread.
/// PHONE4 and RING4 follow the thesis: A upper left, B upper right, C lower left, D lower right, at the
/// corners. CABINET4: A front left, B front right, C back left, D back right. Extents and the presets with 1
/// to 3 actuators are assumptions (Docs/panning.md).
bool layoutPreset(std::string_view name, EnchanterLayout& layout) noexcept;

} // namespace physvib
