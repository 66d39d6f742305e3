// SPDX-License-Identifier: MIT
// Decibels and the standard gravity. All modules use these, so that every level that is set or displayed is
// the same.
#pragma once
#include "Core/PortableMath.h"

namespace physvib {
/// The amplitude factor; 20 dB are a factor of ten. Any thread.
inline double fromDecibels(double decibels) noexcept { return portable::pow(10.0, decibels / 20.0); }

/// Decibels of an amplitude of 0 or more; 0 gives minus infinity. Any thread.
inline double toDecibels(double amplitude) noexcept { return 20.0 * portable::log10(amplitude); }

constexpr double standardGravity = 9.80665; ///< 1 g in m/s^2 (CGPM 1901)

} // namespace physvib
