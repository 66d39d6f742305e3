// SPDX-License-Identifier: MIT
// Reader and writer of Apple's .ahap format: continuous and transient events, and curves that control all of
// them.
//
// Stores: one channel, intensities and sharpnesses from 0 to 1, transients; consecutive continuous events of
// at most 30 s. Does not store: several channels, places, several frequencies at once, phases, levels beyond
// full scale, Hz. Ignored with a note when reading: sound, attack, decay, release, and unknown fields.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// One channel. Amplitude is the intensity squared, sharpness a share of the scale. Values out of range are
/// clamped and missing ones have defaults, as in Apple's definition (Docs/events.md). Any thread.
Result<Clip> readAhap(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// `channel` as such a file. No curve changes a transient (AhapWriter.cpp) or has over 16 points. Any thread.
std::string ahapText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale = {});

} // namespace physvib
