// SPDX-License-Identifier: MIT
// A scene run of a session: a scene from its start on, with its live inputs and stalls.
#pragma once
#include "Scene/Scene.h"
#include <cstdint>
#include <memory>
#include <vector>

namespace physvib {

/// At world time `worldNs` the world is delayed by `lengthNs`, and again after each of the following `steps`
/// - 1 steps (slow motion).
struct WorldStall {
    std::int64_t worldNs = 0;
    std::int64_t lengthNs = 0;
    int steps = 1;
    bool operator==(const WorldStall&) const = default;
};

/// Iterates over the stalls along the steps of their world.
class StallReader {
public:
    explicit StallReader(const std::vector<WorldStall>& stalls) noexcept
        : next_{stalls.begin()}
        , end_{stalls.end()} {}

    /// Delay before the world's step that begins at `worldNs`. Call once per step.
    std::int64_t lengthBefore(std::int64_t worldNs) noexcept {
        std::int64_t length = 0;
        while (next_ != end_ && (done_ > 0 || next_->worldNs <= worldNs)) {
            length += next_->lengthNs;
            if (++done_ < next_->steps) break; // goes on after this step
            ++next_;
            done_ = 0;
        }
        return length;
    }

private:
    std::vector<WorldStall>::const_iterator next_, end_;
    int done_ = 0; // repetitions of *next_
};

struct SceneRun {
    std::int64_t startNs = 0;    ///< session time of world time 0
    std::int64_t worldEndNs = 0; ///< world time up to which it was stepped
    std::uint32_t seed = 1;
    std::shared_ptr<const Scene> scene; ///< in its start state; runs of the same scene may share it
    std::vector<LiveInput> inputs;      ///< since then
    std::vector<WorldStall> stalls;     ///< in time order

    /// The scene with its inputs.
    Scene whole() const {
        Scene all = *scene;
        all.inputs.insert(all.inputs.end(), inputs.begin(), inputs.end());
        return all;
    }
};

} // namespace physvib
