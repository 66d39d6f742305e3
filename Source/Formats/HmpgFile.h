// SPDX-License-Identifier: MIT
// MPEG-I haptics as bits, .hmpg (ISO/IEC 23090-31), as MPEG's reference software of 2025 writes it:
// Docs/decisions/0082.
//
// Carries what .hjif carries, with amplitudes of 8 bits (of each channel's strongest) and frequencies of
// whole Hz. Of what others write it is read what is read of .hjif; check sums are passed over.
#pragma once
#include "Formats/Clip.h"
#include "Io/Result.h"
#include <string>
#include <string_view>

namespace physvib {

/// The clip that these bytes are; or, of the first thing that is wrong, one line `name: byte 123: ...`. Any
/// thread.
Result<Clip> readHmpg(std::string_view bytes, std::string_view name);

/// `clip` (without a clipFault) as bits with 48,000 ticks per second, the same for the same clip; or one
/// line: more bands than the format has numbers for. Titles and labels end after 255 bytes. Any thread.
Result<std::string> hmpgBytes(const Clip& clip);

/// How far a wave may be from what it was, by its 8 bits alone, in shares of full scale. Any thread.
double hmpgStep(const Clip& clip) noexcept;

} // namespace physvib
