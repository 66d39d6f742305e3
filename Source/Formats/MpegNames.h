// SPDX-License-Identifier: MIT
// Names and constants common to both MPEG formats.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace physvib::mpeg {

constexpr int ticksPerSecond = 48000; ///< in written files: onsets are as exact as in a render
// a date is mandatory; a constant one makes equal clips give equal bytes
constexpr std::string_view version = "2023", profile = "Main", date = "1970-01-01T00:00:00Z";
constexpr int level = 1;
constexpr double mostPhase = 6.28318; // 2 pi, as rounded in MPEG's schema
constexpr int anyBodyPart = 0; // of body_part_mask: unspecified; MPEG's reader drops a channel without the
                               // field
constexpr int mostCoordinate = 127; // of a place, in grid points
// indexed by ClipWaveform
constexpr std::array<std::string_view, 5> waveforms{"Sine", "Square", "Triangle", "SawToothUp",
                                                    "SawToothDown"};

inline std::int64_t tickOf(double seconds) { return std::llround(seconds * ticksPerSecond); }

} // namespace physvib::mpeg
