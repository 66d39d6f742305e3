// SPDX-License-Identifier: MIT
// Gain that changes linearly to a new value without clicks; bit-transparent once it rests at 1.
#pragma once
#include <algorithm>
#include <cmath>

namespace physvib {

/// One gain for any number of channels. Render thread (R) only; prepare: message thread (M).
class GainRamp {
public:
    /// Rests at `gain`; a change by 1 takes `secondsPerUnit`. M, not while rendering.
    void prepare(int sampleRateHz, double secondsPerUnit, float gain) noexcept {
        pace_ = step_ = static_cast<float>(1.0 / (secondsPerUnit * sampleRateHz));
        gain_ = target_ = gain;
    }

    void moveTo(float gain) noexcept {
        target_ = gain;
        pace_ = step_;
    }

    /// As moveTo, but finished after at most `frames` frames.
    void moveTo(float gain, int frames) noexcept {
        target_ = gain;
        // the margin keeps rounding from adding a frame
        pace_ = std::max(step_, 1.001f * std::abs(gain - gain_) / static_cast<float>(frames));
    }
    /// Without a ramp: for a channel that is not audible yet.
    void jumpTo(float gain) noexcept { gain_ = target_ = gain; }
    bool isResting() const noexcept { return gain_ == target_; }
    /// True if applying it changes nothing.
    bool isUnity() const noexcept { return gain_ == 1.0f && target_ == 1.0f; }

    float current() const noexcept { return gain_; }
    float target() const noexcept { return target_; }
    /// Lower bound of the gain from now on.
    float minAhead() const noexcept { return std::min(gain_, target_); }
    /// The gain of the next frame.
    float next() noexcept {
        if (!isResting()) step();
        return gain_;
    }

    /// As apply, for silent samples.
    void skip(int frames) noexcept {
        for (int n = 0; n < frames && !isResting(); ++n) step();
    }

    /// Multiplies io[0..channels)[0..frames).
    void apply(float* const* io, int channels, int frames) noexcept {
        int n = 0;
        for (; n < frames && !isResting(); ++n) {
            step();
            for (int j = 0; j < channels; ++j) io[j][n] *= gain_;
        }
        if (gain_ == 1.0f) return;
        for (int j = 0; j < channels; ++j)
            std::transform(io[j] + n, io[j] + frames, io[j] + n, [this](float x) { return x * gain_; });
    }

private:
    void step() noexcept {
        gain_ = gain_ < target_ ? std::min(gain_ + pace_, target_) : std::max(gain_ - pace_, target_);
    }

    float gain_ = 1.0f, target_ = 1.0f, step_ = 1.0f, pace_ = 1.0f;
};

} // namespace physvib
