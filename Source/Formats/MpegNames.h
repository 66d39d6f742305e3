// SPDX-License-Identifier: MIT
// Words and numbers that both of MPEG's formats share.
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace physvib::mpeg {

constexpr int ticksPerSecond = 48000; ///< of what we write: onsets are as exact as in a render
// a date is demanded; the same input gives the same bytes
constexpr std::string_view version = "2023", profile = "Main", date = "1970-01-01T00:00:00Z";
constexpr int level = 1;
constexpr double mostPhase = 6.28318; // 2 pi, as their schema rounds it
constexpr int anyBodyPart = 0;      // of body_part_mask: not told; MPEG's reader drops a channel without one
constexpr int mostCoordinate = 127; // of a place, in points of a grid
// as ClipWaveform
constexpr std::array<std::string_view, 5> waveforms{"Sine", "Square", "Triangle", "SawToothUp",
                                                    "SawToothDown"};

inline std::int64_t tickOf(double seconds) { return std::llround(seconds * ticksPerSecond); }

} // namespace physvib::mpeg
