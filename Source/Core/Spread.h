// SPDX-License-Identifier: MIT
// How an event is distributed over the actuators, if not by the layout's panning law.
#pragma once
#include "Core/PanningLaws.h"
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib {

/// The values between layout and equal are the panning laws with exponent 1: see spreadBy().
enum class Spread : std::uint8_t {
    layout,                         ///< by the panner's law and exponent, as all impacts
    equal = 1 + panningLaws.size(), ///< energy law, scaled so that the squares always sum to one: perceived
                                    ///< strength does not depend on the place
    alone                           ///< the nearest actuator only
};

/// The spread by that law, exponent 1. Any thread.
constexpr Spread spreadBy(PanningLaw law) noexcept {
    return static_cast<Spread>(1 + static_cast<std::size_t>(law));
}

/// Recommended for grains between two actuators and on four corners: the centroid of their intensity is at
/// the contact (Docs/panning.md). Elsewhere: PhantomPanner::travelSpread.
inline constexpr Spread grainSpread = spreadBy(PanningLaw::energy);

/// Names, indexed by Spread.
inline constexpr auto spreadNames = [] {
    std::array<std::string_view, panningLaws.size() + 3> names{"layout"};
    for (const auto& one : panningLaws) names[static_cast<std::size_t>(spreadBy(one.law))] = one.name;
    names[static_cast<std::size_t>(Spread::equal)] = "equal";
    names[static_cast<std::size_t>(Spread::alone)] = "alone";
    return names;
}();

/// The name in files and messages. Any thread.
constexpr std::string_view nameOf(Spread spread) noexcept {
    return spreadNames[static_cast<std::size_t>(spread)];
}

} // namespace physvib
