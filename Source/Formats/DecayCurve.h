// SPDX-License-Identifier: MIT
// Approximates an exponential decay by few line segments with bounded error.
#pragma once
#include "Formats/Clip.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// Points on `amplitude` exp(-decayPerSecond t), in ticks of `ticksPerSecond`, whose chords differ from it by
/// at most `error` times |amplitude|. The last point is 0 where the decay is below that error, or lies on it
/// at `endTick`. Any thread.
std::vector<ClipPoint> decayCurve(double amplitude, double decayPerSecond, std::int64_t endTick, double error,
                                  int ticksPerSecond);

} // namespace physvib
