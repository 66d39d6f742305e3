// SPDX-License-Identifier: GPL-3.0-or-later
// Enchanters that are motors which are on or off: their signal becomes a switch.
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

    /// A step late, as it says what was in it; then as loud as ceiling and master level let it be. R,
    /// wait-free.
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
