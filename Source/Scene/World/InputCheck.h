// SPDX-License-Identifier: MIT
// Checks live inputs before they are applied to a world.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneLimits.h"
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace physvib {

/// Checks the live inputs of one scene in order. One thread at a time.
class InputCheck {
public:
    static constexpr std::size_t unlimited = std::numeric_limits<std::size_t>::max();

    /// The scene must be valid; its inputs count as earlier ones. Accepts `maxInputs` inputs: as many as a
    /// file may hold, or unlimited.
    explicit InputCheck(const Scene& scene, std::size_t maxInputs = sceneLimits::maxLiveInputs);

    /// Checks an input: empty if it is accepted, and is then in effect for later checks; else the error, as
    /// from validate(), and it counts as not given. Takes as long as validate() of the scene with its spawned
    /// bodies. Inputs may name removed bodies, with unlimited inputs only the last `maxRemembered`.
    std::string accept(const Action& action) { return accept(std::span{&action, 1}); }
    /// Accepts several inputs in order, all of them or none.
    std::string accept(std::span<const Action> actions);

    static constexpr std::size_t maxRemembered = 64; ///< because an installation may run for months

private:
    void addIfNeeded(LiveInput input);
    bool mergeInput(const Action& action);
    void dropOldestRemovals();

    Scene scene_; // includes the inputs that later ones are checked against
    std::size_t acceptedCount_, maxInputs_;
};

} // namespace physvib
