// SPDX-License-Identifier: MIT
// What repeats steadily, as ridges do that are passed too fast to be told from what rings.
#pragma once
#include <span>

namespace physvib {

/// Repetitions in a second of what repeats steadily, within 0.1 %; 0 if nothing does. M only.
double repetitionsPerSecond(std::span<const double> samples, double rateHz);

} // namespace physvib
