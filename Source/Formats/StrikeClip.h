// SPDX-License-Identifier: MIT
// Converts events to a clip (one sine at a time per channel and mode, with a piecewise linear envelope), and
// renders clips to samples.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Formats/Clip.h"
#include "Io/Wav/SampledSound.h"
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace physvib {

/// Gains of an event, one per channel.
using EventGains = std::function<void(const CollisionEvent& event, PhantomPanner::Gains& gains)>;

struct EventClipSettings {
    static constexpr int ticksPerSecond = 48000; ///< of onsets, with phase and amplitude of that time
    double error = 0.004; ///< maximum error of the lines relative to the wave's initial amplitude
    std::size_t channels = 0;
    EventGains gains;
};

/// The events (playable, in time order, not moving) as bands of `settings.channels` channels without labels
/// or places. Events of one frequency and decay are merged exactly, as in the mode bank: at each onset the
/// mode's wave ends, and one with the sum's amplitude and phase begins. Stops after exceeding a clip's
/// limits, so that clipError reports it. Any thread.
Clip clipFromEvents(std::span<const CollisionEvent> events, const EventClipSettings& settings);

/// Points on `amplitude` exp(-decayPerSecond t), in ticks, whose chords differ from it by at most `error` of
/// |amplitude|. The last is 0 where the decay is below that error, or lies on it at `endTick`. Any thread.
std::vector<ClipPoint> decayCurve(double amplitude, double decayPerSecond, std::int64_t endTick, double error,
                                  int ticksPerSecond);

/// Every channel of `clip` (which has no clipError) at that sample rate, from 0 s to its end. Waves at or
/// above half the rate are omitted. 1 is full scale. Any thread.
SampledSound clipSound(const Clip& clip, int sampleRateHz);

} // namespace physvib
