// SPDX-License-Identifier: MIT
// Checks live inputs before they reach a world.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneLimits.h"
#include <cstddef>
#include <limits>
#include <span>
#include <string>

namespace physvib {

/// Checks the inputs of one scene in order. One thread at a time.
class InputCheck {
public:
    static constexpr std::size_t endless = std::numeric_limits<std::size_t>::max();

    /// The scene must be valid; its inputs count as earlier ones. Accepts `most` inputs: as many as a file
    /// may hold, or endless.
    explicit InputCheck(const Scene& scene, std::size_t most = sceneLimits::maxLiveInputs);

    /// Empty, and later inputs are checked with this one in effect; or the error, as from validate(). Costs
    /// as much as validate() of the scene with its spawned bodies. A removed body may still be named, without
    /// effect; with endless inputs only the newest `remembered` ones.
    std::string take(const Action& action) { return take(std::span{&action, 1}); }
    /// Accepts several inputs in order, all of them or none.
    std::string take(std::span<const Action> actions);

    static constexpr std::size_t remembered = 64; ///< an installation may spawn and remove for months

private:
    void keep(LiveInput input);
    bool fold(const Action& action);
    void forgetOldest();

    Scene scene_; // with those inputs that later ones are checked against
    std::size_t taken_, most_;
};

} // namespace physvib
