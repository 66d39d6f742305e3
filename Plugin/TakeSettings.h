// SPDX-License-Identifier: GPL-3.0-or-later
// What the render role has to know of a state. It travels inside each take: a take is never played by
// another's settings.
#pragma once
#include "MidiMap.h"

namespace physvib {

struct TakeSettings {
    TransportMode transport = TransportMode::free;
    EnchanterLayout layout;
    MidiTable midi;
};

} // namespace physvib
