// SPDX-License-Identifier: MIT
// Standard gravity (1 g) in SI units.
#pragma once

namespace physvib {

constexpr double standardGravity = 9.80665; ///< m/s^2 (CGPM 1901)

} // namespace physvib
