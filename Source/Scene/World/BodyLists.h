// SPDX-License-Identifier: MIT
// All bodies that a scene can have, in the order in which events number their fixtures; and their paths in
// the scene file, for error messages.
#pragma once
#include "Scene/Scene.h"
#include "Scene/SceneRanges.h"
#include <cstddef>
#include <string>
#include <vector>

namespace physvib {
/// The body that repetition `repetition` (from 0) of a spawn adds, of `times` in all: "stone 3", or "stone"
/// if there is only one. Any thread.
inline BodyDescription spawnedBody(const SpawnAction& spawn, int repetition, int times) {
    BodyDescription body = spawn.body;
    body.positionMetres.x += repetition * spawn.shiftMetres.x;
    body.positionMetres.y += repetition * spawn.shiftMetres.y;
    if (times > 1) body.name.append(1, ' ').append(std::to_string(repetition + 1));
    return body;
}

/// Scene::bodies, then the bodies that the script spawns, in its order. Of a valid scene. Any thread.
inline std::vector<BodyDescription> scriptedBodies(const Scene& scene) {
    std::vector<BodyDescription> bodies = scene.bodies;
    for (const ScriptInput& input : scene.script)
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action))
            for (int i = 0; i < input.times; ++i) bodies.push_back(spawnedBody(*spawn, i, input.times));
    return bodies;
}

/// scriptedBodies(), then the bodies that live inputs spawn or change, in their order. Events number the
/// fixtures of this list consecutively. Any thread.
inline std::vector<BodyDescription> allBodies(const Scene& scene) {
    std::vector<BodyDescription> bodies = scriptedBodies(scene);
    for (const LiveInput& input : scene.inputs)
        if (const BodyDescription* body = bodyAddedBy(input.action)) bodies.push_back(*body);
    return bodies;
}

/// Index of the body that has this fixture number; bodies.size() if none has. Any thread.
inline std::size_t bodyOfFixture(const std::vector<BodyDescription>& bodies, int fixture) noexcept {
    if (fixture < 0) return bodies.size();
    auto remaining = static_cast<std::size_t>(fixture);
    std::size_t body = 0;
    while (body < bodies.size() && remaining >= bodies[body].fixtures.size())
        remaining -= bodies[body++].fixtures.size();
    return body;
}

/// A body of the scene, of its script or of its live inputs.
struct BodyWithPath {
    const BodyDescription* body; ///< of the scene
    std::string path;            ///< as scene files spell it
    int times = 1;               ///< repetitions by the script
    bool isLive = false;         ///< added by a live input, not by the scene or its script
};

/// All bodies in the scene's description, each once; they point into `scene`. Any thread.
inline std::vector<BodyWithPath> bodiesWithPaths(const Scene& scene) {
    std::vector<BodyWithPath> bodies;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i)
        bodies.push_back({&scene.bodies[i], detail::itemPath("bodies", i)});
    for (std::size_t i = 0; i < scene.script.size(); ++i)
        if (const auto* spawn = std::get_if<SpawnAction>(&scene.script[i].action))
            bodies.push_back({&spawn->body, detail::itemPath("script", i) + ".body", scene.script[i].times});
    for (std::size_t i = 0; i < scene.inputs.size(); ++i)
        if (const BodyDescription* body = bodyAddedBy(scene.inputs[i].action))
            bodies.push_back({body, detail::itemPath("inputs", i) + ".body", 1, true});
    return bodies;
}

} // namespace physvib
