// SPDX-License-Identifier: GPL-3.0-or-later
// Parses frequency bands such as "90-1000".
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Io/Text/NumberText.h"
#include <optional>
#include <string_view>

namespace physvib {

/// LO-HI in Hz, LO < HI, above 0.
inline std::optional<FrequencyBand> parseBand(std::string_view text) {
    const std::size_t dash = text.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    const auto low = parseNumber<double>(text.substr(0, dash)),
               high = parseNumber<double>(text.substr(dash + 1));
    if (!low || !high || !FrequencyBand{*low, *high}.isKnown()) return std::nullopt;
    return FrequencyBand{*low, *high};
}

} // namespace physvib
