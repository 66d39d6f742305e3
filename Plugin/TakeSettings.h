// SPDX-License-Identifier: GPL-3.0-or-later
// The part of a plug-in state that the render thread needs. Each scene run carries its own, so it is never
// played with the settings of another.
#pragma once
#include "MidiMap.h"

namespace physvib {

struct TakeSettings {
    TransportMode transport = TransportMode::free;
    EnchanterLayout layout;
    MidiTable midi;
};

} // namespace physvib
