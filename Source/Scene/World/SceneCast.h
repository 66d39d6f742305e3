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
/// Body `repetition` (from 0) of a spawn: "stone 3" where the input has several times, else "stone".
inline BodyDescription spawnedBody(const SpawnAction& spawn, int repetition, int times) {
    BodyDescription body = spawn.body;
    body.positionMetres.x += repetition * spawn.shiftMetres.x;
    body.positionMetres.y += repetition * spawn.shiftMetres.y;
    if (times > 1) body.name.append(1, ' ').append(std::to_string(repetition + 1));
    return body;
}

/// Scene::bodies, then what the script spawns, in its order. The scene must be valid (or its repetitions
/// few). Any thread.
inline std::vector<BodyDescription> scriptedCast(const Scene& scene) {
    std::vector<BodyDescription> cast = scene.bodies;
    for (const ScriptInput& input : scene.script)
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action))
            for (int i = 0; i < input.times; ++i) cast.push_back(spawnedBody(*spawn, i, input.times));
    return cast;
}

/// These, then the bodies that live inputs spawn or change, in their order. Fixture numbers in events count
/// through the fixtures of this list.
inline std::vector<BodyDescription> sceneCast(const Scene& scene) {
    std::vector<BodyDescription> cast = scriptedCast(scene);
    for (const LiveInput& input : scene.inputs)
        if (const BodyDescription* body = bodyPutBy(input.action)) cast.push_back(*body);
    return cast;
}

/// Index of the body that has this fixture number; cast.size() if none has. Any thread.
inline std::size_t bodyOfFixture(const std::vector<BodyDescription>& cast, int fixture) noexcept {
    if (fixture < 0) return cast.size();
    auto left = static_cast<std::size_t>(fixture);
    std::size_t body = 0;
    while (body < cast.size() && left >= cast[body].fixtures.size()) left -= cast[body++].fixtures.size();
    return body;
}

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
