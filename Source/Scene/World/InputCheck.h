// SPDX-License-Identifier: MIT
// Says what is wrong with a live input, before it reaches a world.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneLimits.h"
#include <cstddef>
#include <limits>
#include <string>

namespace physvib {

/// Checks the inputs of one scene as they come. One thread at a time.
class InputCheck {
public:
    static constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();

    /// The scene must be valid; its inputs are those that were before. `most` of them are taken: as many as a
    /// file may hold, or endless.
    explicit InputCheck(const Scene& scene, std::size_t most = sceneLimits::maxLiveInputs);

    /// Empty, and the input counts for those that follow; or what is wrong, as validate() says it. Costs as
    /// much as validate() of the scene with its spawns. A body that was removed may still be named, and
    /// nothing happens; of endless ones the newest `remembered`.
    std::string take(const Action& action);

    static constexpr std::size_t remembered = 64; ///< an installation may spawn and remove for months

private:
    void keep(LiveInput input);
    bool fold(const Action& action);
    void forgetOldest();

    Scene scene_; // of its inputs, those that later ones are checked against
    std::size_t taken_, most_;
};

} // namespace physvib
