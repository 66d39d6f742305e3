// SPDX-License-Identifier: MIT
// Whose vibration a fixture with a camera sends out when something strikes it.
#pragma once

namespace physvib {

/// own: the camera fixture's own material sounds; other: the material of what strikes it; both: one event
/// for each.
enum class Voice { own, other, both };

} // namespace physvib
