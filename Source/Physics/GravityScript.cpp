// SPDX-License-Identifier: MIT
// Looks up the gravity input of a step.
#include "Physics/GravityScript.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {
std::int64_t firstStepAt(double seconds, const StepClock& clock) {
    constexpr double rounding = 1.0e-6; // 0.07 s * 100 is 7.000000000000001: the input belongs to step 7
    return static_cast<std::int64_t>(std::ceil(seconds * clock.stepsPerSecond - rounding));
}
constexpr GravityInput weightless{};
} // namespace

GravityScript::GravityScript(const Scene& scene, const StepClock& clock)
    : periodSteps_(firstStepAt(scene.scriptPeriodSeconds, clock)) {
    for (const GravityInput& input : scene.script)
        entries_.push_back({firstStepAt(input.timeSeconds, clock), input});
}

const GravityInput& GravityScript::at(std::int64_t step) const noexcept {
    if (entries_.empty()) return weightless;
    const std::int64_t phase = periodSteps_ > 0 ? step % periodSteps_ : step;
    const auto isLater = [](std::int64_t s, const Entry& entry) { return s < entry.step; };
    const auto next = std::upper_bound(entries_.begin(), entries_.end(), phase, isLater);
    if (next != entries_.begin()) return std::prev(next)->input;
    return step == phase ? weightless : entries_.back().input;
}

} // namespace physvib
