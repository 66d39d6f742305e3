// SPDX-License-Identifier: MIT
// Scene runs of a session, i.e. a scene with its live inputs and stalls; and edits: actions that add, remove
// or change bodies, joints and materials permanently.
#pragma once
#include "Scene/Scene.h"
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace physvib {

/// At world time `worldNs` the world stops for `lengthNs`, and again after each of the next `steps` - 1
/// steps.
struct WorldStall {
    std::int64_t worldNs = 0;
    std::int64_t lengthNs = 0;
    int steps = 1;
    bool operator==(const WorldStall&) const = default;
};

/// Iterates over a world's stalls along its steps. The list must outlive it.
class StallReader {
public:
    explicit StallReader(const std::vector<WorldStall>& stalls) noexcept
        : next_{stalls.begin()}
        , end_{stalls.end()} {}

    /// Delay in ns before the world's step that begins at `worldNs`. Call once per step.
    std::int64_t delayNsBefore(std::int64_t worldNs) noexcept {
        std::int64_t length = 0;
        while (next_ != end_ && (stepsDone_ > 0 || next_->worldNs <= worldNs)) {
            length += next_->lengthNs;
            if (++stepsDone_ < next_->steps) break; // goes on after this step
            ++next_;
            stepsDone_ = 0;
        }
        return length;
    }

private:
    std::vector<WorldStall>::const_iterator next_, end_;
    int stepsDone_ = 0; // repetitions of *next_
};

/// A scene from its start on, with its live inputs and stalls.
struct SceneRun {
    std::int64_t startNs = 0;    ///< session time of world time 0
    std::int64_t worldEndNs = 0; ///< world time up to which it was stepped
    std::uint32_t seed = 1;
    std::shared_ptr<const Scene> scene; ///< in its start state; runs of the same scene may share it
    std::vector<LiveInput> inputs;      ///< since the start
    std::vector<WorldStall> stalls;     ///< in time order

    /// The scene with the live inputs of this run: simulating it repeats the run.
    Scene fullScene() const {
        Scene all = *scene;
        all.inputs.insert(all.inputs.end(), inputs.begin(), inputs.end());
        return all;
    }
};

/// Applies an action that changes fixtures' materials, sounds, textures, haptic sources or a body to the
/// description of the scene, in its bodies or live inputs; others change nothing. Any thread.
void recordEdit(Scene& scene, const Action& action);

/// True if an action changes the scene permanently and not only its motion. Any thread.
bool isLasting(const Action& action);

/// Number of leading actions that can be validated together: they add, change or remove bodies, each a
/// different one, so that no action repairs the error of another. Any thread.
std::size_t independentActions(std::span<const Action> actions);

/// Applies actions in order like recordEdit(), and also adds and removes bodies and joints. An action that
/// would make the scene invalid changes nothing. Any thread.
void editScene(Scene& scene, std::span<const Action> actions);

/// The scene at the end of a scene run, without inputs: added bodies start where they were added, removed
/// ones are absent (unless a joint holds them or the script needs them). Any thread.
Scene sceneAtEndOfRun(const SceneRun& run);

/// The scene without scripted user input: pushes, tilts and device orientation; with a player (ScenePlayer),
/// the player's actions. Any thread.
Scene sceneForUserInput(Scene scene);

} // namespace physvib
