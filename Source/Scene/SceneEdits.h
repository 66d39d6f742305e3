// SPDX-License-Identifier: MIT
// Scene runs of a session, with their stalls; and actions that edit a scene permanently: they add, remove and
// change bodies, joints and materials.
#pragma once
#include "Scene/Scene.h"
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace physvib {

// A scene run of a session: a scene from its start on, with its live inputs and stalls.

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

// Edits.

/// Applies the permanent changes of `action` to the description: materials of fixtures, sounds, haptic
/// sources; other actions change nothing. Finds the scene's and its live inputs' bodies by name. Any thread.
void describeEdit(Scene& scene, const Action& action);

/// True if an action changes the scene permanently and not only its motion. Any thread.
bool isLasting(const Action& action);

/// Number of leading actions that can be validated together: they add, change or remove bodies, each a
/// different one, so that no action repairs the error of another. Any thread.
std::size_t takenTogether(std::span<const Action> actions);

/// Applies one action after the other as describeEdit does, and also adds and removes bodies and joints. An
/// action that would make the scene invalid changes nothing. Any thread.
void editScene(Scene& scene, std::span<const Action> actions);

/// The scene at the end of a scene run, without inputs: added bodies start where they were added, removed
/// ones are absent (unless a joint holds them or the script needs them). Any thread.
Scene sceneAsLeft(const SceneRun& take);

/// The scene without scripted user input: pushes, tilts and device orientation; with a player (ScenePlayer),
/// the player's actions. Any thread.
Scene sceneForHands(Scene scene);

} // namespace physvib
