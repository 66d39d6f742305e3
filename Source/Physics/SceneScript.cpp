// SPDX-License-Identifier: MIT
// A sorted list of actions, gone through again in every period.
#include "Physics/SceneScript.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {
std::int64_t firstStepAt(double seconds, const StepClock& clock) {
    constexpr double rounding = 1.0e-6; // 0.07 s * 100 is 7.000000000000001: the input belongs to step 7
    return static_cast<std::int64_t>(std::ceil(seconds * clock.stepsPerSecond - rounding));
}
} // namespace

SceneScript::SceneScript(const Scene& scene, const StepClock& clock)
    : periodSteps_(firstStepAt(scene.scriptPeriodSeconds, clock)) {
    for (const ScriptInput& input : scene.script)
        for (int i = 0; i < input.times; ++i) {
            const double seconds = input.timeSeconds + i * input.everySeconds;
            entries_.push_back({firstStepAt(seconds, clock), {&input.action, i, input.times}});
        }
    const auto isEarlier = [](const Entry& a, const Entry& b) { return a.step < b.step; };
    std::stable_sort(entries_.begin(), entries_.end(), isEarlier);
}

DueAction SceneScript::next(std::int64_t step) noexcept {
    if (next_ == entries_.size() && periodSteps_ > 0 && !entries_.empty()) {
        periodStart_ += periodSteps_;
        next_ = 0;
    }
    const bool isDue = next_ < entries_.size() && periodStart_ + entries_[next_].step <= step;
    return isDue ? entries_[next_++].due : DueAction{};
}

} // namespace physvib
