// SPDX-License-Identifier: MIT
// Says what is wrong with a live input, before it reaches a world.
#pragma once
#include "Physics/Scene.h"
#include <cstddef>
#include <string>

namespace physvib {

/// Checks the inputs of one scene as they come. One thread at a time.
class InputCheck {
public:
    /// The scene must be valid; its inputs are those that were before.
    explicit InputCheck(const Scene& scene);

    /// Empty, and the input counts for those that follow; or what is wrong, as validate() says it. Costs as
    /// much as validate() of the scene with its spawns.
    std::string take(const Action& action);

private:
    void keepWhatMatters();

    Scene scene_; // of its inputs, those that later ones are checked against
    std::size_t taken_;
};

} // namespace physvib
