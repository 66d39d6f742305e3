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
    /// Delay of `frames`, filled with silence; `most`, at most Capacity, is the longest delay. False: no
    /// memory. M, not while rendering.
    bool prepare(int fadeFrames, int frames, int most = Capacity) noexcept {
        size_ = static_cast<std::size_t>(most) + 1;
        if (!ring_.resize(size_)) return false;
        fadeFrames_ = std::max(1, fadeFrames);
        most_ = most;
        delay_ = before_ = std::clamp(frames, 0, most);
        faded_ = fadeFrames_;
        next_ = none;
        write_ = 0;
        std::fill_n(ring_.data(), size_, 0.0f);
        silentFrames_ = most;
        return true;
    }

    void moveTo(int frames) noexcept {
        frames = std::clamp(frames, 0, most_);
        if (faded_ < fadeFrames_) { // a fade that is under way is finished first
            next_ = frames;
            return;
        }
        if (frames == delay_) return;
        before_ = delay_;
        delay_ = frames;
        faded_ = 0;
    }

    /// True if the output equals the input.
    bool isOut() const noexcept { return delay_ == 0 && faded_ == fadeFrames_; }

    /// True if the line holds only silence and no fade is under way.
    bool isResting() const noexcept { return silentFrames_ >= most_ && faded_ == fadeFrames_; }

    /// While isOut: the memory for the next `frames` inputs. Null if it is not contiguous.
    float* placeFor(int frames) noexcept {
        const std::size_t next = write_ + 1 == size_ ? 0 : write_ + 1;
        return next + static_cast<std::size_t>(frames) <= size_ ? ring_.data() + next : nullptr;
    }
    /// Replaces process: the inputs have been written to placeFor, and are not silent.
    void pass(int frames) noexcept {
        write_ += static_cast<std::size_t>(frames);
        if (write_ >= size_) write_ -= size_;
        silentFrames_ = 0;
    }

    /// In place. `isSilent`: all input is 0. True if all output is 0.
    bool process(float* io, int frames, bool isSilent) noexcept {
        if (isSilent && silentFrames_ >= most_) {
            faded_ = std::min(fadeFrames_, faded_ + frames);
            goOn();
            return true;
        }
        const bool passes = isOut();
        if (passes)
            keep(io, static_cast<std::size_t>(frames));
        else
            std::transform(io, io + frames, io, [this](float x) { return step(x); });
        silentFrames_ = isSilent ? std::min(most_, silentFrames_ + frames) : 0;
        return passes && isSilent;
    }

private:
    static constexpr int none = -1;

    float at(int delay) const noexcept {
        const auto back = static_cast<std::size_t>(delay);
        return ring_[write_ >= back ? write_ - back : write_ + size_ - back];
    }
    void keep(float x) noexcept {
        write_ = write_ + 1 == size_ ? 0 : write_ + 1;
        ring_[write_] = x;
    }
    // Blocks are short: copies of constant size need no library call.
    static void copy(const float* from, std::size_t count, float* to) noexcept {
        constexpr std::size_t whole = 16;
        std::size_t k = 0;
        for (; k + whole <= count; k += whole) std::memcpy(to + k, from + k, whole * sizeof(float));
        std::copy_n(from + k, count - k, to + k);
    }
    // Inputs are stored even without a delay: a delay that is set later starts with them.
    void keep(const float* x, std::size_t frames) noexcept {
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
        keep(x);
        if (faded_ == fadeFrames_) return at(delay_);
        const float share = static_cast<float>(++faded_) / static_cast<float>(fadeFrames_);
        const float y = at(before_) + share * (at(delay_) - at(before_));
        goOn();
        return y;
    }
    void goOn() noexcept {
        if (faded_ == fadeFrames_ && next_ != none) moveTo(std::exchange(next_, none));
    }

    Storage<float, static_cast<std::size_t>(Capacity) + 1, true> ring_;
    std::size_t write_ = 0, size_ = 0;
    int delay_ = 0, before_ = 0, faded_ = 1, fadeFrames_ = 1, next_ = none;
    int most_ = 0, silentFrames_ = 0; // silentFrames_: trailing silent inputs, at most most_
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
            ramps_[index(j)].prepare(sampleRateHz, limits::channelRampSeconds, aimOf(j));
        return prepareEqualisers(sampleRateHz) && prepareDelays(sampleRateHz);
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

    /// True if no channel is changed. The caller still copies the samples to kept[j], for a delay that may be
    /// set later.
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
    bool prepareEqualisers(int sampleRateHz) noexcept {
        if (!equalisers_.resize(index(channels_))) return false;
        for (int j = 0; j < channels_; ++j) equalisers_[index(j)] = {actuators_[index(j)], sampleRateHz};
        return true;
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
    Storage<ActuatorEqualiser, width, true> equalisers_;
    std::array<GainRamp, width> ramps_{};
    std::array<float, width> gains_{};
    float level_ = 1.0f;
    std::array<bool, width> muted_{};
};

} // namespace physvib
