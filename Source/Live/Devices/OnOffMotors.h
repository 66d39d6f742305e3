// SPDX-License-Identifier: MIT
// Converts the signals of on/off motors (ERMs without speed control) into switching signals.
#pragma once
#include "Core/Actuators/VibrationConverter.h"
#include <algorithm>
#include <cstddef>
#include <vector>

namespace physvib {

class OnOffMotors {
public:
    /// `enchanters` from 0. M, while R does not run.
    void prepare(const std::vector<int>& enchanters, int sampleRateHz, double threshold) {
        motors_.clear();
        for (const int j : enchanters)
            motors_.push_back({static_cast<std::size_t>(j), OnOffSteps{sampleRateHz, threshold}});
    }

    /// The switch state follows one step late, because a step is judged by all samples in it. Ceiling and
    /// master level set the on level. R, wait-free.
    void apply(float* const* channels, int frames) noexcept {
        for (Motor& motor : motors_)
            for (int n = 0; n < frames; ++n) {
                float& sample = channels[motor.enchanter][n];
                motor.steps.take(sample, [](long long, bool) {});
                sample = motor.steps.isOn() ? 1.0f : 0.0f;
            }
    }

    /// R.
    bool has(int enchanter) const noexcept {
        return std::ranges::find(motors_, static_cast<std::size_t>(enchanter), &Motor::enchanter) !=
               motors_.end();
    }

private:
    struct Motor {
        std::size_t enchanter;
        OnOffSteps steps;
    };
    std::vector<Motor> motors_;
};

} // namespace physvib
