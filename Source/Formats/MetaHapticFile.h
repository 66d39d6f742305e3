// SPDX-License-Identifier: MIT
// Reader and writer of Meta's .haptic format, which FMOD and Wwise also read: one envelope of amplitude, one
// of frequency, and emphasis points.
//
// Stores: one channel, amplitudes and frequencies from 0 to 1, transients as emphasis, any length. Does not
// store: several channels, places, several frequencies at once, phases, levels beyond full scale, Hz.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// One channel: the envelope as a wave, emphasis as transients; 0.5 of the scale without frequencies and
/// before their first. A one-line error if it breaks one of Meta's rules: values from 0 to 1, times in order,
/// at least two points of amplitude, emphasis at least as strong as the envelope. Any thread.
Result<Clip> readMetaHaptic(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// Number of transients that are weaker than the envelope beside them; the format requires them to be raised
/// to it. Any thread.
std::size_t metaHapticRaised(const ClipChannel& channel);

/// `channel` as such a file. Any thread.
std::string metaHapticText(const ClipChannel& channel, std::string_view title,
                           const FrequencyScale& scale = {});

} // namespace physvib
