// SPDX-License-Identifier: MIT
// Which body's sound an impact of a haptic source plays.
#pragma once

namespace physvib {

/// own: the sound of the haptic source; other: that of the body that collides with it; both: one event for
/// each.
enum class Voice { own, other, both };

} // namespace physvib
