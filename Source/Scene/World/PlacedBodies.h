// SPDX-License-Identifier: MIT
// Lists all bodies that a scene describes, with their paths in the file for error messages.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneRanges.h"
#include <string>
#include <vector>

namespace physvib {

/// A body of the scene, of its script or of its live inputs.
struct PlacedBody {
    const BodyDescription* body; ///< of the scene
    std::string path;            ///< as scene files spell it
    int times = 1;
    bool isLive = false; ///< of a live input
};

inline std::vector<PlacedBody> placedBodies(const Scene& scene) {
    std::vector<PlacedBody> bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        bodies.push_back({&scene.bodies[i], detail::itemPath("bodies", i)});
    for (std::size_t i = 0; i < scene.script.size(); ++i)
        if (const auto* spawn = std::get_if<SpawnAction>(&scene.script[i].action))
            bodies.push_back({&spawn->body, detail::itemPath("script", i) + ".body", scene.script[i].times});
    for (std::size_t i = 0; i < scene.inputs.size(); ++i)
        if (const BodyDescription* body = bodyPutBy(scene.inputs[i].action))
            bodies.push_back({body, detail::itemPath("inputs", i) + ".body", 1, true});
    return bodies;
}

} // namespace physvib
