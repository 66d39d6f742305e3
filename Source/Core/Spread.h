// SPDX-License-Identifier: MIT
// How a strike is spread over the enchanters, where it does not leave that to the layout's own law.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace physvib {

enum class Spread : std::uint8_t {
    layout,   ///< as every hit: by the law and exponent of the panner
    linear,   ///< the panner's laws by name, exponent 1
    log,
    logOuter,
    energy,
    equal,    ///< energy, scaled so that the squares sum to one wherever it is: the felt strength stays
    alone     ///< the nearest enchanter, and no other
};

/// In their order.
inline constexpr std::array<std::string_view, 7> spreadNames{"layout", "linear", "log", "log-outer", "energy", "equal", "alone"};

} // namespace physvib
