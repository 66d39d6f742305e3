// SPDX-License-Identifier: MIT
// Reader and writer of .hmpg, MPEG-I haptics as a bit stream (ISO/IEC 23090-31), as in MPEG's reference
// software of 2025: Docs/decisions/0082.
//
// Stores what .hjif stores, with amplitudes of 8 bits (relative to each channel's largest) and frequencies in
// whole Hz. Reads from other writers what is read of .hjif; checksums are not verified.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// The clip of these bytes; or, for the first error, one line `name: byte 123: ...`. Any thread.
Result<Clip> readHmpg(std::string_view bytes, std::string_view name);

/// `clip` (without a clipFault) as a bit stream with 48,000 ticks per second, equal for equal clips; or a
/// one-line error if there are more bands than the format can number. Titles and labels are cut at 255 bytes.
/// Any thread.
Result<std::string> hmpgBytes(const Clip& clip);

/// Largest error of a wave by the 8 bits alone, in shares of full scale. Any thread.
double hmpgStep(const Clip& clip) noexcept;

} // namespace physvib
