// SPDX-License-Identifier: MIT
// Iterates over the script's actions sorted by step, again in every period.
#include "Scene/SceneScript.h"
#include <algorithm>

namespace physvib {

SceneScript::SceneScript(const Scene& scene, const StepClock& clock)
    : periodSteps_(clock.firstStepAt(scene.scriptPeriodSeconds)) {
    for (const ScriptInput& input : scene.script)
        for (int i = 0; i < input.times; ++i) {
            const double seconds = input.timeSeconds + i * input.everySeconds;
            entries_.push_back({clock.firstStepAt(seconds), {&input.action, i, input.times}});
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
