// SPDX-License-Identifier: MIT
// Reader and writer of .hjif, MPEG-I haptics as JSON (ISO/IEC 23090-31).
//
// Stores: channels with labels, places and actuators, bands of waves with phases, frequencies up to 10 kHz,
// any length. Does not store: places finer than 127 points across the field; panning laws and events as such.
// Reads from other writers: vibrotactile perceptions with vectorial, transient and curve bands; not wavelets
// or composite effects.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The clip that `text` describes; or, for the first error, one line `name: perceptions[0].channels[1]...`.
/// Optional fields may be missing, unknown ones are ignored. Any thread.
Result<Clip> readHjif(std::string_view text, std::string_view name);

/// `clip` (without a clipFault) as JSON with 48,000 ticks per second. Equal clips give equal text, because
/// the date is constant. Any thread.
std::string hjifText(const Clip& clip);

/// What .hjif cannot store of `clip`, of these frequencies, one line each. Any thread.
std::vector<std::string> hjifLosses(const Clip& clip, const std::set<double>& frequenciesHz);

} // namespace physvib
