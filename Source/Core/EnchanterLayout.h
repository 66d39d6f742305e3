// SPDX-License-Identifier: MIT
// Positions of 1 to 64 actuators ("enchanter configuration" in the thesis, 3.2, 6.1), and the part of the
// body that each one is on.
#pragma once
#include "Core/Limits.h"
#include "Core/NameNumbers.h"
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
    int count = 0;                   ///< 1 to limits::maxActuators; channel j is places[j]
    std::array<ActuatorPlace, limits::maxActuators> places{}; ///< the first `count` are used
};

/** The earlier name, kept for old code. */ using EnchanterPlace = ActuatorPlace;
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

// Preset layouts on a body, in space: the tips of a hand's fingers, a forearm and a torso.
//
// Sizes are those of an average adult, assumed and not measured. x points to the wearer's right, y up or
// along the limb, z backwards, as in OpenGL and most engines: the chest has a smaller z than the back.

/// Parts of a body that presets name, and that every file can therefore write by name. Any name is a part.
inline constexpr std::array<std::string_view, 15> bodyParts{
    "palm",    "thumb",     "index", "middle", "ring",  "little", "hand",   "wrist",
    "forearm", "upper-arm", "chest", "back",   "waist", "seat",   "cabinet"};

/// One preset.
struct BodyLayout {
    std::string_view name;                 ///< as layoutPreset() takes it
    double widthMetres;                    ///< of the extent
    double heightMetres;                   ///< of the extent
    std::span<const ActuatorPlace> places; ///< from the extent's centre
};

/// Tips of a right hand's spread, slightly bent fingers. Seen from its back, so the palm has the smaller z.
inline constexpr std::array<ActuatorPlace, 5> gloveTips{{{0.0, 0.0, -0.035, partNamed("thumb")},
                                                         {0.06, 0.085, -0.01, partNamed("index")},
                                                         {0.085, 0.095, -0.005, partNamed("middle")},
                                                         {0.11, 0.085, -0.01, partNamed("ring")},
                                                         {0.14, 0.06, -0.02, partNamed("little")}}};

/// Two rings of four around a forearm of 9 cm across, 10 cm apart; x is along the arm towards the hand. Each
/// ring begins on top and goes by the side that looks to the viewer (z above 0) to below and behind.
inline constexpr auto sleevePlaces = [] {
    std::array<ActuatorPlace, 8> places{};
    constexpr double radius = 0.045;
    constexpr std::array<double, 4> up{1.0, 0.0, -1.0, 0.0}, out{0.0, 1.0, 0.0, -1.0};
    for (std::size_t j = 0; j < places.size(); ++j)
        places[j] = {j < 4 ? 0.0 : 0.1, radius + radius * up[j % 4], radius * out[j % 4],
                     partNamed("forearm")};
    return places;
}();

/// Two columns of four on the chest, then two on the back, rows from the wearer's left to right, from above.
inline constexpr auto vestPlaces = [] {
    std::array<ActuatorPlace, 16> places{};
    for (std::size_t j = 0; j < places.size(); ++j) {
        const bool isBack = j >= 8;
        places[j] = {j % 2 == 0 ? 0.0 : 0.2, 0.36 - 0.12 * static_cast<double>(j % 8 / 2),
                     isBack ? 0.11 : -0.11, partNamed(isBack ? "back" : "chest")};
    }
    return places;
}();

inline constexpr std::array<BodyLayout, 3> bodyLayouts{{{"glove5", 0.14, 0.095, gloveTips},
                                                        {"sleeve8", 0.1, 0.09, sleevePlaces},
                                                        {"vest16", 0.2, 0.36, vestPlaces}}};

} // namespace physvib
