// SPDX-License-Identifier: MIT
// One stretch of a session: a scene from its start on, with what was done to it, and when the world stood still.
#pragma once
#include "Physics/Scene.h"
#include <cstdint>
#include <memory>
#include <vector>

namespace physvib {

/// From world time `worldNs` on, the world is `lengthNs` later than before.
struct WorldStall {
    std::int64_t worldNs = 0;
    std::int64_t lengthNs = 0;
    bool operator==(const WorldStall&) const = default;
};

struct SceneTake {
    std::int64_t startNs = 0;    ///< session time of world time 0
    std::int64_t worldEndNs = 0; ///< up to which it was stepped
    std::uint32_t seed = 1;
    std::shared_ptr<const Scene> scene; ///< as it started; takes of the same scene may share it
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
