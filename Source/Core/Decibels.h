// SPDX-License-Identifier: MIT
// Amplitudes and their decibels, in one arithmetic: the same bits wherever a level is set or told.
#pragma once
#include <cmath>

namespace physvib {

/// 20 dB are a factor of ten. Any thread.
inline double fromDecibels(double decibels) noexcept { return std::pow(10.0, decibels / 20.0); }

/// Of an amplitude of 0 or more; 0 is minus infinity. Any thread.
inline double toDecibels(double amplitude) noexcept { return 20.0 * std::log10(amplitude); }

} // namespace physvib
