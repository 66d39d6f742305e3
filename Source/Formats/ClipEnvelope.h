// SPDX-License-Identifier: MIT
// A channel as phones know it: one amplitude and one frequency at any moment.
#pragma once
#include "Formats/Clip.h"
#include <cmath>
#include <vector>

namespace physvib {

struct EnvelopePoint {
    double seconds = 0.0;
    double amplitude = 0.0;   ///< 0 or more
    double frequencyHz = 0.0; ///< held while nothing sounds
};

/// All waves of the channel in one: amplitudes by the root of their summed squares, frequencies weighted by those squares.
/// Transients are left out. Times grow; a jump takes `riseSeconds`. Begins and ends at amplitude 0. Any thread.
std::vector<EnvelopePoint> envelopeOf(const ClipChannel& channel, double riseSeconds = 0.0005);

/// As few points of `curve` as keep within `tolerance` of it. Any thread.
std::vector<ClipPoint> thinned(const std::vector<ClipPoint>& curve, double tolerance);

/// Of a time, an amplitude or a share all that anybody feels, in few digits. Any thread.
inline double shortened(double value) { return std::round(value * 1e6) / 1e6; }

} // namespace physvib
