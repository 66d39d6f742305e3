// SPDX-License-Identifier: MIT
// A scene's gravity inputs by step index: the same inputs act in the same steps, however fast the world is
// run.
#pragma once
#include "Physics/Scene.h"
#include "Physics/StepClock.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// The script of a valid scene at a fixed step rate. An input acts from the first step that begins at or
/// after its time; before the first input there is no gravity. Allocates in its constructor only. M only.
class GravityScript {
public:
    GravityScript(const Scene& scene, const StepClock& clock);

    /// The input in force at a step (>= 0); the time in it is that of the script, not of the world.
    const GravityInput& at(std::int64_t step) const noexcept;

private:
    struct Entry {
        std::int64_t step;
        GravityInput input;
    };
    std::int64_t periodSteps_; // 0: does not repeat
    std::vector<Entry> entries_;
};

} // namespace physvib
