// SPDX-License-Identifier: MIT
// From strikes to a clip: per channel and mode one sine at a time, whose amplitude falls along lines.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Formats/Clip.h"
#include <functional>
#include <span>

namespace physvib {

/// Gains of an event, one per channel.
using StrikeGains = std::function<void(const CollisionEvent& event, PhantomPanner::Gains& gains)>;

struct StrikeClipSettings {
    static constexpr int ticksPerSecond = 48000; ///< onsets lie on these, with the phase and amplitude that
                                                 ///< they have there
    double error = 0.004; ///< of the amplitude that a wave begins with: how far its lines may be from the
                          ///< exponential
    std::size_t channels = 0;
    StrikeGains gains;
};

/// The strikes (playable, in time order, none of which moves) as bands of `settings.channels` channels
/// without labels or places. Strikes of one frequency and decay are merged exactly, as in the mode bank: at
/// each onset the wave of that mode ends and one with the sum's amplitude and phase begins. Of more than a
/// clip may have only so much that clipFault says so. Any thread.
Clip clipOfStrikes(std::span<const CollisionEvent> events, const StrikeClipSettings& settings);

} // namespace physvib
