// SPDX-License-Identifier: MIT
// Preset layouts on a body, in space: the tips of a hand's fingers, a forearm and a torso.
//
// Sizes are those of an average adult, assumed and not measured. x points to the wearer's right, y up or
// along the limb, z backwards, as in OpenGL and most engines: the chest has a smaller z than the back.
#pragma once
#include "Core/EnchanterLayout.h"
#include <array>
#include <span>
#include <string_view>

namespace physvib {

/// Parts of a body that presets name, and that every file can therefore write by name. Any name is a part.
inline constexpr std::array<std::string_view, 15> bodyParts{
    "palm",    "thumb",     "index", "middle", "ring",  "little", "hand",   "wrist",
    "forearm", "upper-arm", "chest", "back",   "waist", "seat",   "cabinet"};

/// One preset.
struct BodyLayout {
    std::string_view name;
    double widthMetres, heightMetres; ///< the extent
    std::span<const ActuatorPlace> places;
};

/// Tips of a right hand's spread, slightly bent fingers. The hand is seen from its back, so the palm has the
/// smaller z.
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

/// Two columns of four on the chest, then two on the back, each row from the wearer's left to the right, from
/// above.
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
