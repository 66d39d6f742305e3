// SPDX-License-Identifier: MIT
// Apple's .ahap: continuous and transient events, and curves that control them all.
//
// Carries: one channel, intensities and sharpnesses from 0 to 1, transients; continuous events of at most 30
// s that follow one another.
//
// Does not carry: several channels, places, several frequencies at once, phases, levels beyond full scale,
// Hz.
//
// Left out of what others write, and told: sound, attack, decay, release, and what is not known.
#pragma once
#include "Formats/Clip.h"
#include "Formats/FrequencyScale.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// One channel. Amplitude is the intensity squared, sharpness a share of the scale. Values beyond their range
/// are brought to its ends and missing ones have defaults, as Apple has it (Docs/formats.md). Any thread.
Result<Clip> readAhap(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// `channel` as such a file; no curve bends a transient (see AhapPieces.h), or has more than 16 points. Any
/// thread.
std::string ahapText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale = {});

} // namespace physvib
