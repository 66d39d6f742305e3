// SPDX-License-Identifier: MIT
// A scene's script by step index: the same inputs act in the same steps, whatever the speed of the
// simulation.
#pragma once
#include "Scene/Scene.h"
#include "Scene/World/StepClock.h"
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace physvib {

/// An action that is due; `repetition` counts an input's repetitions from 0.
struct DueAction {
    const Action* action = nullptr; ///< of the scene
    int repetition = 0;
    int times = 1;
};

/// The script of a valid scene at a fixed step rate. An input acts in the first step that begins at or after
/// its time, those of one step in their order in the scene. Allocates in its constructor only. M only.
class SceneScript {
public:
    /// `scene` outlives the script.
    SceneScript(const Scene& scene, const StepClock& clock)
        : periodSteps_(clock.firstStepAt(scene.scriptPeriodSeconds)) {
        for (const ScriptInput& input : scene.script)
            for (int i = 0; i < input.times; ++i) {
                const double seconds = input.timeSeconds + i * input.everySeconds;
                entries_.push_back({clock.firstStepAt(seconds), {&input.action, i, input.times}});
            }
        const auto isEarlier = [](const Entry& a, const Entry& b) { return a.step < b.step; };
        std::stable_sort(entries_.begin(), entries_.end(), isEarlier);
    }

    /// The next action that is due in step `step` or before, each once; nullptr `action` if there is none.
    /// Steps are asked for in ascending order.
    DueAction next(std::int64_t step) noexcept {
        if (next_ == entries_.size() && periodSteps_ > 0 && !entries_.empty()) {
            periodStart_ += periodSteps_;
            next_ = 0;
        }
        const bool isDue = next_ < entries_.size() && periodStart_ + entries_[next_].step <= step;
        return isDue ? entries_[next_++].due : DueAction{};
    }

private:
    struct Entry {
        std::int64_t step;
        DueAction due;
    };
    std::int64_t periodSteps_;   // 0: does not repeat
    std::vector<Entry> entries_; // by step
    std::int64_t periodStart_ = 0;
    std::size_t next_ = 0;
};

} // namespace physvib
