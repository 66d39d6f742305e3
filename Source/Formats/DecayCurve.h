// SPDX-License-Identifier: MIT
// An exponential as few lines: chords whose error is bounded.
#pragma once
#include "Formats/Clip.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Points on `amplitude` exp(-decayPerSecond t), t in ticks of `ticksPerSecond`, whose chords differ from it
/// by at most `error` times |amplitude|; the last is 0 where it would be below that, or lies on it at
/// `endTick`. Any thread.
std::vector<ClipPoint> decayCurve(double amplitude, double decayPerSecond, std::int64_t endTick, double error,
                                  int ticksPerSecond);

} // namespace physvib
