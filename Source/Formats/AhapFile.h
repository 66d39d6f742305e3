// SPDX-License-Identifier: MIT
// Apple's .ahap: continuous and transient events, and curves that control them all.
//
// Carries: one channel, intensities and sharpnesses from 0 to 1, transients; continuous events of at most 30
// s, which follow one another. Does not carry: several channels, places, several frequencies at once, phases,
// levels beyond full scale, Hz. Of what others write, sound is left out, and so are attack, decay and
// release.
#pragma once
#include "Files/Result.h"
#include "Formats/Clip.h"
#include "Formats/FrequencyScale.h"
#include <string>
#include <string_view>

namespace physvib {

/// One channel. Amplitude is the intensity squared, sharpness a share of the scale. Values beyond their range
/// are brought to its ends, as Apple does; a missing intensity is 1, a missing sharpness 0.5 (assumed). Any
/// thread.
Result<Clip> readAhap(std::string_view text, std::string_view name, const FrequencyScale& scale = {});

/// `channel` as such a file. Any thread.
std::string ahapText(const ClipChannel& channel, std::string_view title, const FrequencyScale& scale = {});

} // namespace physvib
