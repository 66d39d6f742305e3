// SPDX-License-Identifier: MIT
// Meta's .haptic, which FMOD and Wwise read as well: one envelope of amplitude, one of frequency, and points
// of emphasis.
//
// Carries: one channel, amplitudes and frequencies from 0 to 1, transients as emphasis, any length.
// Does not carry: several channels, places, several frequencies at once, phases, levels beyond full scale,
// Hz.
#pragma once
#include "Formats/Clip.h"
#include "Formats/FrequencyScale.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// One channel: the envelope as a wave, emphasis as transients; without frequencies, and before their first,
/// 0.5 of the scale. One line if it breaks a rule of Meta's: values from 0 to 1, times in order, two points
/// of amplitude or more, emphasis at least as strong as the envelope. Any thread.
Result<Clip> readMetaHaptic(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// How many transients are weaker than what else sounds there: the format has none such, and they become as
/// strong. Any thread.
std::size_t metaHapticRaised(const ClipChannel& channel);

/// `channel` as such a file. Any thread.
std::string metaHapticText(const ClipChannel& channel, std::string_view title,
                           const FrequencyScale& scale = {});

} // namespace physvib
