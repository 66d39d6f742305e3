// SPDX-License-Identifier: MIT
// Writer of control points for Android's VibrationEffect.WaveformEnvelopeBuilder: Android has no file of its
// own, so an app reads this JSON and hands each point to addControlPoint (Docs/events.md).
//
// Stores: one channel, amplitude 0 to 1, Hz, whole milliseconds. An effect has at most 16 points of at most a
// second each, which every phone with envelopes takes, and begins at amplitude 0, as the builder does.
#pragma once
#include "Formats/Clip.h"
#include <cmath>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

// A channel reduced to one amplitude and one frequency at any time, as phone formats store it.

constexpr double envelopeRiseSeconds = 0.0005; ///< duration of a jump: felt as a step

struct EnvelopePoint {
    double seconds = 0.0;
    double amplitude = 0.0;   ///< 0 or more
    double frequencyHz = 0.0; ///< held during silence
};

/// All waves of the channel combined, without transients: the root of their summed squares, the frequency
/// weighted by these. Times increase; a jump takes `riseSeconds`. From amplitude 0 to 0. Any thread.
std::vector<EnvelopePoint> makeEnvelope(const ClipChannel& channel, double riseSeconds = envelopeRiseSeconds);

/// On the line from `a` to `b`, at that share. Any thread.
inline EnvelopePoint interpolated(const EnvelopePoint& a, const EnvelopePoint& b, double share) {
    return {std::lerp(a.seconds, b.seconds, share), std::lerp(a.amplitude, b.amplitude, share),
            std::lerp(a.frequencyHz, b.frequencyHz, share)};
}

/// The envelope at that time; silence before its first point and after its last. Any thread.
EnvelopePoint envelopeAt(std::span<const EnvelopePoint> envelope, double seconds);

/// Its points between two times, plus one at both. Any thread.
std::vector<EnvelopePoint> envelopeSlice(std::span<const EnvelopePoint> envelope, double fromSeconds,
                                         double toSeconds);

/// The fewest points of `curve` that stay within `tolerance` of it. Any thread.
std::vector<ClipPoint> simplifiedCurve(const std::vector<ClipPoint>& curve, double tolerance);

/// Rounds a time, amplitude or share to what is perceptible, for short numbers. Any thread.
inline double roundedForFile(double value) { return std::round(value * 1e6) / 1e6; }

struct AndroidPoint {
    double amplitude = 0.0, frequencyHz = 0.0;
    int durationMs = 0; ///< from the point before, along a line
};

/// One VibrationEffect.
struct AndroidEffect {
    int startMs = 0;
    double initialHz = 0.0;
    std::vector<AndroidPoint> points; ///< 1 to 16
};

/// Few points, whose lines are within 1 % (0.09 dB; 0.0002 below 0.02) and 1 Hz of the channel's envelope,
/// transients included, at every millisecond, except where an effect takes over from another: a rise of 1 ms.
/// Frequencies beyond `scale`, which phones do not play, become its ends. Any thread.
std::vector<AndroidEffect> androidEffects(const ClipChannel& channel, const FrequencyScale& scale = {});

/// `channel` as such a file. Any thread.
std::string envelopeText(const ClipChannel& channel, std::string_view title,
                         const FrequencyScale& scale = {});

} // namespace physvib
