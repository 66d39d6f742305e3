// SPDX-License-Identifier: MIT
// How a strike is spread over the enchanters, where it does not leave that to the layout's own law.
#pragma once
#include "Core/PanningLaws.h"
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib {

/// Those between are the laws of the table, with exponent 1: see spreadBy().
enum class Spread : std::uint8_t {
    layout,                         ///< as every hit: by the law and exponent of the panner
    equal = 1 + panningLaws.size(), ///< energy, scaled so that the squares sum to one wherever it is: the
                                    ///< felt strength stays
    alone                           ///< the nearest enchanter, and no other
};

/// By that law, exponent 1. Any thread.
constexpr Spread spreadBy(PanningLaw law) noexcept {
    return static_cast<Spread>(1 + static_cast<std::size_t>(law));
}

/// Of grains, where nobody asked for another: the centroid of their intensity is where they are
/// (Docs/panning.md).
inline constexpr Spread grainSpread = spreadBy(PanningLaw::energy);

/// In their order.
inline constexpr auto spreadNames = [] {
    std::array<std::string_view, panningLaws.size() + 3> names{"layout"};
    for (const auto& one : panningLaws) names[static_cast<std::size_t>(spreadBy(one.law))] = one.name;
    names[static_cast<std::size_t>(Spread::equal)] = "equal";
    names[static_cast<std::size_t>(Spread::alone)] = "alone";
    return names;
}();

/// As files and messages have it. Any thread.
constexpr std::string_view nameOf(Spread spread) noexcept {
    return spreadNames[static_cast<std::size_t>(spread)];
}

} // namespace physvib
