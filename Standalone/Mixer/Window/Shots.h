// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures of the window's states without a display: for the documents, and to look at.
#pragma once
#include <juce_core/juce_core.h>

namespace physvib {

/// Names of the states, in the order of the documents.
juce::StringArray shotStates();

/// Draws the window in that state to a PNG file, in the state's own size or in `size` ("1280x683"); empty, or
/// what went wrong. Takes some seconds: the world moves. M.
juce::String takeShot(const juce::File& file, const juce::String& state, const juce::String& size = {});

} // namespace physvib
