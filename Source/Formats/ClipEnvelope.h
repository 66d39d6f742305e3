// SPDX-License-Identifier: MIT
// A channel as phones know it: one amplitude and one frequency at any moment.
#pragma once
#include "Formats/Clip.h"
#include <cmath>
#include <span>
#include <vector>

namespace physvib {

constexpr double envelopeRiseSeconds = 0.0005; ///< what a jump takes: a step to a hand

struct EnvelopePoint {
    double seconds = 0.0;
    double amplitude = 0.0;   ///< 0 or more
    double frequencyHz = 0.0; ///< held while nothing sounds
};

/// All waves of the channel in one: amplitudes by the root of their summed squares, frequencies weighted by
/// those squares. Transients are left out. Times grow; a jump takes `riseSeconds`. Begins and ends at
/// amplitude 0. Any thread.
std::vector<EnvelopePoint> envelopeOf(const ClipChannel& channel, double riseSeconds = envelopeRiseSeconds);

/// On the line from `a` to `b`, at that share of the way. Any thread.
inline EnvelopePoint between(const EnvelopePoint& a, const EnvelopePoint& b, double share) {
    return {std::lerp(a.seconds, b.seconds, share), std::lerp(a.amplitude, b.amplitude, share),
            std::lerp(a.frequencyHz, b.frequencyHz, share)};
}

/// What the envelope is at that time: silence before its first point and after its last. Any thread.
EnvelopePoint pointAt(std::span<const EnvelopePoint> envelope, double seconds);

/// Its points from one time to a later one, and one at both. Any thread.
std::vector<EnvelopePoint> partOf(std::span<const EnvelopePoint> envelope, double fromSeconds,
                                  double toSeconds);

/// As few points of `curve` as keep within `tolerance` of it. Any thread.
std::vector<ClipPoint> thinned(const std::vector<ClipPoint>& curve, double tolerance);

/// Of a time, an amplitude or a share all that anybody feels, in few digits. Any thread.
inline double shortened(double value) { return std::round(value * 1e6) / 1e6; }

} // namespace physvib
