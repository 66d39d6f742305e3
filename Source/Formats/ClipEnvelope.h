// SPDX-License-Identifier: MIT
// A channel reduced to one amplitude and one frequency at any time, as phone formats store it.
#pragma once
#include "Formats/Clip.h"
#include <cmath>
#include <span>
#include <vector>

namespace physvib {

constexpr double envelopeRiseSeconds = 0.0005; ///< duration of a jump: felt as a step

struct EnvelopePoint {
    double seconds = 0.0;
    double amplitude = 0.0;   ///< 0 or more
    double frequencyHz = 0.0; ///< held during silence
};

/// All waves of the channel combined: amplitude is the root of their summed squares, frequency is weighted by
/// those squares. Transients are excluded. Times increase; a jump takes `riseSeconds`. Begins and ends at
/// amplitude 0. Any thread.
std::vector<EnvelopePoint> envelopeOf(const ClipChannel& channel, double riseSeconds = envelopeRiseSeconds);

/// On the line from `a` to `b`, at that share. Any thread.
inline EnvelopePoint between(const EnvelopePoint& a, const EnvelopePoint& b, double share) {
    return {std::lerp(a.seconds, b.seconds, share), std::lerp(a.amplitude, b.amplitude, share),
            std::lerp(a.frequencyHz, b.frequencyHz, share)};
}

/// The envelope at that time; silence before its first point and after its last. Any thread.
EnvelopePoint pointAt(std::span<const EnvelopePoint> envelope, double seconds);

/// Its points between two times, plus one at both. Any thread.
std::vector<EnvelopePoint> partOf(std::span<const EnvelopePoint> envelope, double fromSeconds,
                                  double toSeconds);

/// The fewest points of `curve` that stay within `tolerance` of it. Any thread.
std::vector<ClipPoint> thinned(const std::vector<ClipPoint>& curve, double tolerance);

/// Rounds a time, amplitude or share to what is perceptible, for short numbers. Any thread.
inline double shortened(double value) { return std::round(value * 1e6) / 1e6; }

} // namespace physvib
