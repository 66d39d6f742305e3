// SPDX-License-Identifier: GPL-3.0-or-later
// Which part of a recording was chosen, kept in a small file below it.
#pragma once
#include <juce_core/juce_core.h>
#include <string>

namespace physvib {

/// The folder below the takes for what belongs to them and is not listed.
juce::File partsFolder(const juce::File& take);

/// The part that was kept, s; all of the take if none was, or if it was of a take of another length. Message
/// thread.
juce::Range<double> keptPart(const juce::File& take, double seconds);

/// All of the take needs no file. Empty, or one line. Message thread.
std::string keepPart(const juce::File& take, double seconds, juce::Range<double> part);

} // namespace physvib
