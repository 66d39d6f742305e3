// SPDX-License-Identifier: MIT
// Writer of control points for Android's VibrationEffect.WaveformEnvelopeBuilder: Android has no file of its
// own, so an app reads this JSON and hands each point to addControlPoint (Docs/events.md).
//
// Stores: one channel, amplitude 0 to 1, Hz, whole milliseconds. An effect has at most 16 points of at most a
// second each, which every phone with envelopes takes, and begins at amplitude 0, as the builder does.
#pragma once
#include "Formats/Clip.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct AndroidPoint {
    double amplitude = 0.0, hertz = 0.0;
    int milliseconds = 0; ///< from the point before, along a line
};

/// One VibrationEffect.
struct AndroidEffect {
    int startMilliseconds = 0;
    double initialHertz = 0.0;
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
