// SPDX-License-Identifier: GPL-3.0-or-later
// A part of a recording: how loud it is over time, and the part as a recording of its own.
#pragma once
#include <functional>
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// The largest sample in each of so many equal parts of a recording; empty if it cannot be read, or when
/// `goesOn` has returned false. Any thread.
std::vector<float> takeLevels(const juce::File& take, int columns, const std::function<bool()>& goesOn);

/// From the first part that can be felt to the last, s; all of it if there is none. Any thread.
juce::Range<double> soundingPart(const std::vector<float>& levels, double seconds);

/// Writes that part, and the events in it, as a recording of its own. An edge within the sound fades in 5 ms.
/// Empty, or one line. Message thread.
std::string writeTakePart(const juce::File& take, juce::Range<double> seconds, const juce::File& to);

} // namespace physvib
