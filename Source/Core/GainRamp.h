// SPDX-License-Identifier: MIT
// A gain that moves in a straight line to its next value: no step, no click; bit-transparent once it rests at 1.
#pragma once
#include <algorithm>

namespace physvib {

/// One gain for any number of channels. R only, but for prepare: M.
class GainRamp {
public:
    /// Rests at `gain`; a change of 1 takes `secondsPerUnit`. M, not while rendering.
    void prepare(int sampleRateHz, double secondsPerUnit, float gain) noexcept {
        step_ = static_cast<float>(1.0 / (secondsPerUnit * sampleRateHz));
        now_ = target_ = gain;
    }

    void moveTo(float gain) noexcept { target_ = gain; }
    bool isResting() const noexcept { return now_ == target_; }

    /// Multiplies io[0..channels)[0..frames).
    void apply(float* const* io, int channels, int frames) noexcept {
        int n = 0;
        for (; n < frames && !isResting(); ++n) {
            now_ = now_ < target_ ? std::min(now_ + step_, target_) : std::max(now_ - step_, target_);
            for (int j = 0; j < channels; ++j) io[j][n] *= now_;
        }
        if (now_ == 1.0f) return;
        for (int j = 0; j < channels; ++j) std::transform(io[j] + n, io[j] + frames, io[j] + n, [this](float x) { return x * now_; });
    }

private:
    float now_ = 1.0f, target_ = 1.0f, step_ = 1.0f;
};

} // namespace physvib
