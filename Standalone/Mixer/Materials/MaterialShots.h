// SPDX-License-Identifier: GPL-3.0-or-later
// The materials as they are shown in pictures: one was measured, from a recording that is made for it.
#pragma once
#include "Mixer/Window/MixerView.h"

namespace physvib {

/// Writes a knock on wood: 352 Hz, 98 /s, two higher partials, and a little noise; the same samples each
/// time. True if it was written.
bool writeKnock(const juce::File& file);

/// Opens the tab and measures such a knock; returns when it is done.
void showMaterials(Desk& desk, MixerView& view);

} // namespace physvib
