// SPDX-License-Identifier: GPL-3.0-or-later
// Says of a material or a new body that it is not felt at usual impacts, with a button that changes this; and
// of levels that nothing is.
#pragma once
#include "Mixer/Desk/Desk.h"

namespace physvib {

/// Shows the message, or takes it away if what is asked about is felt. Message thread only.
void hintOnMaterial(Desk& desk, int material);
void hintOnBody(Desk& desk, const std::string& body);

/// Why these levels let nothing be felt, whatever plays; empty: they do not. Any thread.
juce::String whySilent(const Mix& mix);
void hintOnLevels(Desk& desk, const juce::String& why);

} // namespace physvib
