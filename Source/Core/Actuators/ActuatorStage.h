// SPDX-License-Identifier: MIT
// Per-channel processing before the linked limiter: equaliser, delay, gain, polarity, mute.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/Actuators/ChannelDelay.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <cmath>

namespace physvib {

/// Per channel: out = gain * delayed, equalised in. Every change is a ramp of limits::channelRampSeconds,
/// except before the first frame. Render thread (R) only; prepare: message thread (M).
class ActuatorStage {
public:
    /// All gains 1, nothing muted or delayed, equalisers at rest. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, int channels, const EqualisedActuators& equalised = {}) noexcept {
        channels_ = channels;
        hasBegun_ = false;
        actuators_ = equalised;
        prepareEqualisers(sampleRateHz);
        for (auto& ramp : ramps_) ramp.prepare(sampleRateHz, limits::channelRampSeconds, 1.0f);
        gains_.fill(1.0f);
        level_ = 1.0f;
        muted_.fill(false);
        delaySeconds_.fill(0.0f);
        return prepareDelays(sampleRateHz);
    }

    /// Continues at another sample rate. Settings stay; samples inside equalisers and delays are lost. False:
    /// no memory. M, not while rendering.
    bool changeRate(int sampleRateHz) noexcept {
        prepareEqualisers(sampleRateHz);
        for (int j = 0; j < channels_; ++j)
            ramps_[index(j)].prepare(sampleRateHz, limits::channelRampSeconds, aimOf(j));
        return prepareDelays(sampleRateHz);
    }

    /// Negative gains invert the polarity.
    void setGain(int channel, float gain) noexcept {
        gains_[index(channel)] = gain;
        aim(channel);
    }

    /// Gain of all channels, multiplied with their own.
    void setLevel(float level) noexcept {
        level_ = level;
        for (int j = 0; j < channels_; ++j) aim(j);
    }

    /// After the ramp a muted channel is exactly silent, so it does not affect the limiter.
    void setMuted(int channel, bool muted) noexcept {
        muted_[index(channel)] = muted;
        aim(channel);
    }

    /// 0 to limits::maxChannelDelaySeconds.
    void setDelay(int channel, float seconds) noexcept {
        delaySeconds_[index(channel)] = seconds;
        delays_[index(channel)].moveTo(framesOf(channel));
        isAsleep_ = false;
    }

    /// True if every channel leaves unchanged. Its samples are still to be copied to kept[j], for a delay
    /// that may be set later.
    bool passes(float** kept, int frames) noexcept {
        for (int j = 0; j < channels_; ++j) {
            const auto c = index(j);
            if (equalisers_[c].isOn() || !delays_[c].isOut() || !ramps_[c].isOne() ||
                (kept[j] = delays_[c].placeFor(frames)) == nullptr)
                return false;
        }
        return true;
    }
    /// Replaces process if `passes` was true: the copies have been written, and are not silent.
    void pass(int frames) noexcept {
        hasBegun_ = true;
        isAsleep_ = false;
        for (int j = 0; j < channels_; ++j) delays_[index(j)].pass(frames);
    }

    /// In place. `isSilent`: all input is 0. True if all output is 0: an equaliser may still decay.
    bool process(float* const* io, int frames, bool isSilent) noexcept {
        hasBegun_ = true;
        if (isSilent && isAsleep_) return true;
        bool allSilent = true;
        isAsleep_ = isSilent;
        for (int j = 0; j < channels_; ++j) {
            const auto c = index(j);
            const bool isQuiet =
                equalisers_[c].isOn() ? equalisers_[c].process(io[j], frames, isSilent) : isSilent;
            const bool none = delays_[c].process(io[j], frames, isQuiet);
            if (none)
                ramps_[c].pass(frames);
            else
                ramps_[c].apply(io + j, 1, frames);
            allSilent = allSilent && none;
            isAsleep_ = isAsleep_ && none && delays_[c].isResting() && ramps_[c].isResting();
        }
        return allSilent;
    }

private:
    void prepareEqualisers(int sampleRateHz) noexcept {
        for (int j = 0; j < channels_; ++j) equalisers_[index(j)] = {actuators_[index(j)], sampleRateHz};
    }
    static constexpr std::size_t index(int channel) noexcept { return static_cast<std::size_t>(channel); }
    float aimOf(int channel) const noexcept {
        return muted_[index(channel)] ? 0.0f : level_ * gains_[index(channel)];
    }
    void aim(int channel) noexcept {
        isAsleep_ = false;
        if (hasBegun_)
            ramps_[index(channel)].moveTo(aimOf(channel));
        else
            ramps_[index(channel)].jumpTo(aimOf(channel));
    }

    int framesOf(int channel) const noexcept {
        return static_cast<int>(
            std::lround(delaySeconds_[index(channel)] * static_cast<float>(sampleRateHz_)));
    }
    bool prepareDelays(int sampleRateHz) noexcept {
        sampleRateHz_ = sampleRateHz;
        isAsleep_ = false;
        const int most =
            std::min(limits::maxDelayFrames,
                     static_cast<int>(std::lround(limits::maxChannelDelaySeconds * sampleRateHz)));
        bool has = true;
        for (int j = 0; j < channels_; ++j)
            has = delays_[index(j)].prepare(static_cast<int>(limits::channelRampSeconds * sampleRateHz),
                                            framesOf(j), most) &&
                  has;
        return has;
    }

    static constexpr auto width = static_cast<std::size_t>(limits::maxEnchanters);
    int channels_ = 0;
    bool hasBegun_ = false;
    bool isAsleep_ = false; // all channels are at rest, so that silence needs no processing
    int sampleRateHz_ = 48000;
    std::array<ChannelDelay<limits::maxDelayFrames>, width> delays_{};
    std::array<float, width> delaySeconds_{};
    EqualisedActuators actuators_{};
    std::array<ActuatorEqualiser, width> equalisers_{};
    std::array<GainRamp, width> ramps_{};
    std::array<float, width> gains_{};
    float level_ = 1.0f;
    std::array<bool, width> muted_{};
};

} // namespace physvib
