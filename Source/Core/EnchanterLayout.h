// SPDX-License-Identifier: MIT
// Positions of 1 to 64 actuators ("enchanter configuration" in the thesis, 3.2, 6.1), and the part of the
// body that each one is on.
#pragma once
#include "Core/Limits.h"
#include "Core/PartNumber.h"
#include <array>
#include <span>
#include <string_view>

namespace physvib {

/// One actuator's place on the layout, metres from its lower left corner.
struct ActuatorPlace {
    double xMetres = 0.0; ///< from the left
    double yMetres = 0.0; ///< from below
    double zMetres = 0.0; ///< across the plane of x and y, towards the viewer; may be negative
    PartNumber part = 0;  ///< part of the body that it is on; 0: none
};

/// Places of the actuators, in channel order. The field of the world is mapped onto `extent`; z is scaled as
/// x is, and has the same zero in both.
struct ActuatorLayout {
    double extentWidthMetres = 0.0;  ///< above 0
    double extentHeightMetres = 0.0; ///< above 0
    int count = 0;                   ///< 1 to limits::maxEnchanters; channel j is places[j]
    std::array<ActuatorPlace, limits::maxEnchanters> places{}; ///< the first `count` are used
};

/** The names that they had first. */ using EnchanterPlace = ActuatorPlace;
using EnchanterLayout = ActuatorLayout; ///< Likewise.

/// True if all actuators have the same z, so that x and y alone decide. Any thread.
bool isFlat(const ActuatorLayout& layout) noexcept;

/// True if an actuator is on a part of the body. Any thread.
bool hasParts(const ActuatorLayout& layout) noexcept;

/// True if the layout can be panned over: count in range, extent positive, everything finite. Any thread.
bool isValid(const ActuatorLayout& layout) noexcept;

/// Names of the presets, in the order of the table in EnchanterLayout.cpp.
extern const std::span<const std::string_view> layoutPresetNames;

/// Fills `layout` with the preset of that name; false (and `layout` unchanged) if there is none. Any thread.
/// PHONE4 and RING4 follow the thesis: A upper left, B upper right, C lower left, D lower right, at the
/// corners. CABINET4: A front left, B front right, C back left, D back right. GLOVE5, SLEEVE8 and VEST16 are
/// in space and name parts of the body. Extents, the presets with 1 to 3 actuators and those in space are
/// assumptions (Docs/panning.md).
bool layoutPreset(std::string_view name, ActuatorLayout& layout) noexcept;

} // namespace physvib
