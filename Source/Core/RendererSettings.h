// SPDX-License-Identifier: MIT
// What a HapticRenderer is set up with, and what it counts.
#pragma once
#include "Core/Actuators/ActuatorStage.h"
#include "Core/Actuators/DriveMatrices.h"
#include "Core/Limits.h"
#include "Core/Modes/InstructionSet.h"
#include "Core/PhantomPanner.h"
#include <algorithm>
#include <array>
#include <cstdint>

namespace physvib {

/// Whether anything can be rendered at that rate. Any thread.
constexpr bool isSampleRate(int hz) noexcept {
    return hz >= limits::minSampleRateHz && hz <= limits::maxSampleRateHz;
}

/// What a renderer is set up with.
struct RendererSettings {
    int sampleRateHz = 48000; ///< isSampleRate
    int channels = 0; ///< outputs; 0: as many as the panner has enchanters. Without one an output is silent.
                      ///< At most limits::maxEnchanters
    PhantomPanner panner;       ///< at most `channels` enchanters; can be changed by a control
    bool limiterEnabled = true; ///< off: samples may exceed 1, no OutputGuard acts; the latency stays the
                                ///< same
    std::array<float, limits::maxEnchanters> ceilings = fullScale(); ///< drive ceiling per channel, > 0
    int modes = 0; ///< that sound at once; one more steals the quietest, which is counted. Memory follows it.
                   ///< At most, and if it is 0, limits::maxModes
    InstructionSet instructions = InstructionSet::best; ///< one that is not available: scalar
    EqualisedActuators equalised{}; ///< per channel; without figures it is played as it is
    DriveMatrices drives{}; ///< of the panner's enchanters, against their coupling; empty: none. They outlive
                            ///< the renderer

    /** What grows with the modes: of `most` at `mostModes` as many, but for `least`. */ int
    shareOf(int most, int mostModes, int least) const noexcept {
        return modes == 0 ? most
                          : std::min(most, std::max(least, static_cast<int>(static_cast<std::int64_t>(most) *
                                                                            modes / mostModes)));
    }
    /// Channels that are rendered.
    int outputs() const noexcept { return channels > 0 ? channels : panner.channels(); }

    static constexpr std::array<float, limits::maxEnchanters> fullScale() {
        std::array<float, limits::maxEnchanters> all{};
        all.fill(1.0f);
        return all;
    } ///< 1 for each.
};

/// Counts since prepare, and the state after the last call.
struct RenderStatus {
    std::int64_t framesRendered = 0; ///< since prepare
    std::uint64_t played = 0;        ///< events struck
    std::uint64_t late = 0;          ///< of these: after their time, at once
    std::uint64_t rejected = 0;      ///< not playable, above half the sample rate, or no gate was free
    std::uint64_t stolen = 0;        ///< modes faded out early to make room
    std::uint64_t nonFinite = 0;     ///< samples that became silence
    std::uint64_t untold = 0;        ///< played, but the played queue was full
    int liveModes = 0;               ///< that ring
    int pending = 0;                 ///< events whose time has not come
    float limiterGain = 1.0f;        ///< now; 1: it does nothing
    float guardGain = 1.0f;          ///< as limiterGain, of the channel that OutputGuard turns down most
    std::uint64_t guarded = 0;       ///< how often it began to
};

} // namespace physvib
