// SPDX-License-Identifier: MIT
// Parts of a body (palm, thumb, chest) as numbers: actuators belong to one, and an event may be felt on one
// alone.
#pragma once
#include "Core/Fnv1a.h"
#include <cstdint>
#include <limits>
#include <string_view>

namespace physvib {

using PartNumber = std::int32_t; ///< 0: none; above: of a name

/// The number of a part, which follows from its name alone, as that of a sound; "": 0. Two names share a
/// number with a probability of 5e-10. Any thread.
constexpr PartNumber partNamed(std::string_view name) noexcept {
    if (name.empty()) return 0;
    return static_cast<PartNumber>(fnv1a(name) % std::numeric_limits<PartNumber>::max()) + 1;
}

} // namespace physvib
