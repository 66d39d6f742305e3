// SPDX-License-Identifier: MIT
// MPEG-I haptics as JSON, .hjif (ISO/IEC 23090-31).
//
// Carries: channels with labels, places and actuators, bands of waves with phases, frequencies up to 10 kHz,
// any length. Does not carry: places finer than 127 points across the field; panning laws and strikes as
// such. Of what others write it is read: vibrotactile perceptions with vectorial, transient and curve bands;
// not wavelets, nor composite effects.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// The clip that `text` describes; or, of the first thing that is wrong, one line `name:
/// perceptions[0].channels[1]...`. Fields that are not needed may be missing or unknown. Any thread.
Result<Clip> readHjif(std::string_view text, std::string_view name);

/// `clip` (without a clipFault) as JSON with 48,000 ticks per second; the same text for the same clip: its
/// date says nothing. Any thread.
std::string hjifText(const Clip& clip);

} // namespace physvib
