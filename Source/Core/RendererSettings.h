// SPDX-License-Identifier: MIT
// Settings of a HapticRenderer, and its status counters.
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

/// True if the renderer supports that sample rate. Any thread.
constexpr bool isSampleRate(int hz) noexcept {
    return hz >= limits::minSampleRateHz && hz <= limits::maxSampleRateHz;
}

/// Settings of HapticRenderer::prepare.
struct RendererSettings {
    int sampleRateHz = 48000; ///< see isSampleRate
    int channels = 0; ///< outputs; 0: as many as the panner has actuators. Outputs without an actuator are
                      ///< silent. At most limits::maxEnchanters
    PhantomPanner panner;       ///< at most `channels` actuators; a control can change it
    bool limiterEnabled = true; ///< off: samples may exceed 1 and no OutputGuard acts; the latency stays the
                                ///< same
    std::array<float, limits::maxEnchanters> ceilings = fullScale(); ///< drive ceiling per channel, > 0
    int modes = 0; ///< modes that sound at once; a further one steals the quietest, which is counted. Memory
                   ///< depends on it. 0, and at most: limits::maxModes
    InstructionSet instructions = InstructionSet::best; ///< one that is not available: scalar
    EqualisedActuators equalised{}; ///< equalisation per channel; a channel without measured figures is not
                                    ///< equalised
    DriveMatrices drives{}; ///< matrices against mechanical coupling of the panner's actuators; empty: none.
                            ///< The caller keeps them alive

    /** `most` times modes / mostModes, but at least `least`; `most` if modes is 0. Any thread. */ int
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
    } ///< A ceiling of 1 for each channel.
};

/// Counts since prepare, and the state after the last call of render.
struct RenderStatus {
    std::int64_t framesRendered = 0; ///< since prepare
    std::uint64_t played = 0;        ///< events started
    std::uint64_t late = 0;          ///< of these: after their time, started at once
    std::uint64_t rejected = 0;      ///< not playable, above half the sample rate, or without a free gate
    std::uint64_t withoutPart = 0;   ///< of those played: PhantomPanner::lacksPartOf, felt on all by place
    std::uint64_t stolen = 0;        ///< modes faded out early because all slots were used
    std::uint64_t nonFinite = 0;     ///< samples that were not finite and became 0
    std::uint64_t untold = 0;        ///< played events that the full played queue refused
    int liveModes = 0;               ///< modes that sound
    int pending = 0;                 ///< events whose time has not come
    float limiterGain = 1.0f;        ///< current gain; 1: no reduction
    float guardGain = 1.0f;          ///< lowest gain of the OutputGuard over all channels; 1: no reduction
    std::uint64_t guarded = 0;       ///< how often the guard began to reduce
};

} // namespace physvib
