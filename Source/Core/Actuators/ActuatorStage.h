// SPDX-License-Identifier: MIT
// Per-channel processing before the linked limiter: equaliser, delay, gain, polarity, mute.
#pragma once
#include "Core/Actuators/ActuatorEqualiser.h"
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include "Core/Storage.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <utility>

namespace physvib {

/// Delay line of one channel; a change of delay in play is cross-faded. Render thread (R) only; prepare:
/// message thread (M).
template <int Capacity>
class ChannelDelay {
public:
    /// Delay of `frames`, filled with silence; `maxFrames`, at most Capacity, is the longest delay. False: no
    /// memory. M, not while rendering.
    bool prepare(int fadeFrames, int frames, int maxFrames = Capacity) noexcept {
        size_ = static_cast<std::size_t>(maxFrames) + 1;
        if (!ring_.resize(size_)) return false;
        fadeFrames_ = std::max(1, fadeFrames);
        maxFrames_ = maxFrames;
        delay_ = previousDelay_ = std::clamp(frames, 0, maxFrames);
        fadedFrames_ = fadeFrames_;
        pendingDelay_ = none;
        write_ = 0;
        std::fill_n(ring_.data(), size_, 0.0f);
        silentFrames_ = maxFrames;
        return true;
    }

    void moveTo(int frames) noexcept {
        frames = std::clamp(frames, 0, maxFrames_);
        if (fadedFrames_ < fadeFrames_) { // a fade that is under way is finished first
            pendingDelay_ = frames;
            return;
        }
        if (frames == delay_) return;
        previousDelay_ = delay_;
        delay_ = frames;
        fadedFrames_ = 0;
    }

    /// True if the output equals the input.
    bool isBypassed() const noexcept { return delay_ == 0 && fadedFrames_ == fadeFrames_; }

    /// True if the line holds only silence and no fade is under way.
    bool isResting() const noexcept { return silentFrames_ >= maxFrames_ && fadedFrames_ == fadeFrames_; }

    /// While isBypassed(): the memory for the next `frames` inputs. Null if it is not contiguous.
    float* inputsFor(int frames) noexcept {
        const std::size_t next = write_ + 1 == size_ ? 0 : write_ + 1;
        return next + static_cast<std::size_t>(frames) <= size_ ? ring_.data() + next : nullptr;
    }
    /// Replaces process: the inputs have been written to inputsFor, and are not silent.
    void bypass(int frames) noexcept {
        write_ += static_cast<std::size_t>(frames);
        if (write_ >= size_) write_ -= size_;
        silentFrames_ = 0;
    }

    /// In place. `isSilent`: all input is 0. True if all output is 0.
    bool process(float* io, int frames, bool isSilent) noexcept {
        if (isSilent && silentFrames_ >= maxFrames_) {
            for (; frames > 0 && fadedFrames_ < fadeFrames_; --frames) { // an ended move starts the next
                ++fadedFrames_;
                startPendingMove();
            }
            return true;
        }
        const bool isCopied = isBypassed();
        if (isCopied)
            store(io, static_cast<std::size_t>(frames));
        else
            std::transform(io, io + frames, io, [this](float x) { return step(x); });
        silentFrames_ = isSilent ? std::min(maxFrames_, silentFrames_ + frames) : 0;
        return isCopied && isSilent;
    }

private:
    static constexpr int none = -1;

    float at(int delay) const noexcept {
        const auto back = static_cast<std::size_t>(delay);
        return ring_[write_ >= back ? write_ - back : write_ + size_ - back];
    }
    void store(float x) noexcept {
        write_ = write_ + 1 == size_ ? 0 : write_ + 1;
        ring_[write_] = x;
    }
    // Blocks are short: copies of constant size need no library call.
    static void copy(const float* from, std::size_t count, float* to) noexcept {
        constexpr std::size_t chunk = 16;
        std::size_t k = 0;
        for (; k + chunk <= count; k += chunk) std::memcpy(to + k, from + k, chunk * sizeof(float));
        std::copy_n(from + k, count - k, to + k);
    }
    // Inputs are stored even without a delay: a delay that is set later starts with them.
    void store(const float* x, std::size_t frames) noexcept {
        while (frames > 0) {
            const std::size_t next = write_ + 1 == size_ ? 0 : write_ + 1,
                              part = std::min(frames, size_ - next);
            copy(x, part, ring_.data() + next);
            write_ = next + part - 1;
            x += part;
            frames -= part;
        }
    }
    float step(float x) noexcept {
        store(x);
        if (fadedFrames_ == fadeFrames_) return at(delay_);
        const float share = static_cast<float>(++fadedFrames_) / static_cast<float>(fadeFrames_);
        const float y = at(previousDelay_) + share * (at(delay_) - at(previousDelay_));
        startPendingMove();
        return y;
    }
    void startPendingMove() noexcept {
        if (fadedFrames_ == fadeFrames_ && pendingDelay_ != none) moveTo(std::exchange(pendingDelay_, none));
    }

    Storage<float, static_cast<std::size_t>(Capacity) + 1, true> ring_;
    std::size_t write_ = 0, size_ = 0;
    int delay_ = 0, previousDelay_ = 0, fadedFrames_ = 1, fadeFrames_ = 1, pendingDelay_ = none;
    int maxFrames_ = 0, silentFrames_ = 0; // silentFrames_: trailing silent inputs, at most maxFrames_
};

/// Per channel: out = gain * delayed, equalised in. Every change is a ramp of limits::channelRampSeconds,
/// except before the first frame. Render thread (R) only; prepare: message thread (M).
class ActuatorStage {
public:
    /// All gains 1, nothing muted or delayed, equalisers at rest. False: no memory. M, not while rendering.
    bool prepare(int sampleRateHz, int channels, const EqualisedActuators& equalised = {}) noexcept {
        channels_ = channels;
        hasBegun_ = false;
        actuators_ = equalised;
        for (auto& ramp : ramps_) ramp.prepare(sampleRateHz, limits::channelRampSeconds, 1.0f);
        gains_.fill(1.0f);
        level_ = 1.0f;
        muted_.fill(false);
        delaySeconds_.fill(0.0f);
        return prepareEqualisers(sampleRateHz) && prepareDelays(sampleRateHz);
    }

    /// Continues at another sample rate. Settings stay; samples inside equalisers and delays are lost. False:
    /// no memory. M, not while rendering.
    bool changeRate(int sampleRateHz) noexcept {
        for (int j = 0; j < channels_; ++j)
            ramps_[index(j)].prepare(sampleRateHz, limits::channelRampSeconds, targetGain(j));
        return prepareEqualisers(sampleRateHz) && prepareDelays(sampleRateHz);
    }

    /// Negative gains invert the polarity.
    void setGain(int channel, float gain) noexcept {
        gains_[index(channel)] = gain;
        updateTarget(channel);
    }

    /// Gain of all channels, multiplied with their own.
    void setLevel(float level) noexcept {
        level_ = level;
        for (int j = 0; j < channels_; ++j) updateTarget(j);
    }

    /// After the ramp a muted channel is exactly silent, so it does not affect the limiter.
    void setMuted(int channel, bool isMuted) noexcept {
        muted_[index(channel)] = isMuted;
        updateTarget(channel);
    }

    /// 0 to limits::maxChannelDelaySeconds.
    void setDelay(int channel, float seconds) noexcept {
        delaySeconds_[index(channel)] = seconds;
        delays_[index(channel)].moveTo(framesOf(channel));
        isAsleep_ = false;
    }

    /// True if no channel is changed. The caller still copies the samples to inputs[j], because a delay may
    /// be set later.
    bool canBypass(float** inputs, int frames) noexcept {
        for (int j = 0; j < channels_; ++j) {
            const auto c = index(j);
            if (equalisers_[c].isOn() || !delays_[c].isBypassed() || !ramps_[c].isUnity() ||
                (inputs[j] = delays_[c].inputsFor(frames)) == nullptr)
                return false;
        }
        return true;
    }
    /// Replaces process if canBypass was true: the copies have been written, and are not silent.
    void bypass(int frames) noexcept {
        hasBegun_ = true;
        isAsleep_ = false;
        for (int j = 0; j < channels_; ++j) delays_[index(j)].bypass(frames);
    }

    /// In place. `isSilent`: all input is 0. True if all output is 0: an equaliser may still decay.
    bool process(float* const* io, int frames, bool isSilent) noexcept {
        hasBegun_ = true;
        if (isSilent && isAsleep_) return true;
        bool areAllSilent = true;
        isAsleep_ = isSilent;
        for (int j = 0; j < channels_; ++j) {
            const auto c = index(j);
            const bool isQuiet =
                equalisers_[c].isOn() ? equalisers_[c].process(io[j], frames, isSilent) : isSilent;
            const bool isOutputSilent = delays_[c].process(io[j], frames, isQuiet);
            if (isOutputSilent)
                ramps_[c].skip(frames);
            else
                ramps_[c].apply(io + j, 1, frames);
            areAllSilent = areAllSilent && isOutputSilent;
            isAsleep_ = isAsleep_ && isOutputSilent && delays_[c].isResting() && ramps_[c].isResting();
        }
        return areAllSilent;
    }

private:
    bool prepareEqualisers(int sampleRateHz) noexcept {
        if (!equalisers_.resize(index(channels_))) return false;
        for (int j = 0; j < channels_; ++j) equalisers_[index(j)] = {actuators_[index(j)], sampleRateHz};
        return true;
    }
    static constexpr std::size_t index(int channel) noexcept { return static_cast<std::size_t>(channel); }
    float targetGain(int channel) const noexcept {
        return muted_[index(channel)] ? 0.0f : level_ * gains_[index(channel)];
    }
    void updateTarget(int channel) noexcept {
        isAsleep_ = false;
        if (hasBegun_)
            ramps_[index(channel)].moveTo(targetGain(channel));
        else
            ramps_[index(channel)].jumpTo(targetGain(channel));
    }

    int framesOf(int channel) const noexcept {
        return static_cast<int>(
            std::lround(delaySeconds_[index(channel)] * static_cast<float>(sampleRateHz_)));
    }
    bool prepareDelays(int sampleRateHz) noexcept {
        sampleRateHz_ = sampleRateHz;
        isAsleep_ = false;
        const int maxFrames =
            std::min(limits::maxDelayFrames,
                     static_cast<int>(std::lround(limits::maxChannelDelaySeconds * sampleRateHz)));
        bool hasMemory = true;
        for (int j = 0; j < channels_; ++j)
            hasMemory = delays_[index(j)].prepare(static_cast<int>(limits::channelRampSeconds * sampleRateHz),
                                                  framesOf(j), maxFrames) &&
                        hasMemory;
        return hasMemory;
    }

    static constexpr auto width = static_cast<std::size_t>(limits::maxActuators);
    int channels_ = 0;
    bool hasBegun_ = false;
    bool isAsleep_ = false; // all channels are at rest, so that silence needs no processing
    int sampleRateHz_ = 48000;
    std::array<ChannelDelay<limits::maxDelayFrames>, width> delays_{};
    std::array<float, width> delaySeconds_{};
    EqualisedActuators actuators_{};
    Storage<ActuatorEqualiser, width, true> equalisers_;
    std::array<GainRamp, width> ramps_{};
    std::array<float, width> gains_{};
    float level_ = 1.0f;
    std::array<bool, width> muted_{};
};

} // namespace physvib
