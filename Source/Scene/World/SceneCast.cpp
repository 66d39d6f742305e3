// SPDX-License-Identifier: MIT
// Names, numbers and places of spawned bodies.
#include "Scene/World/SceneCast.h"

namespace physvib {

BodyDescription spawnedBody(const SpawnAction& spawn, int repetition, int times) {
    BodyDescription body = spawn.body;
    body.positionMetres.x += repetition * spawn.shiftMetres.x;
    body.positionMetres.y += repetition * spawn.shiftMetres.y;
    if (times > 1) body.name.append(1, ' ').append(std::to_string(repetition + 1));
    return body;
}

std::vector<BodyDescription> scriptedCast(const Scene& scene) {
    std::vector<BodyDescription> cast = scene.bodies;
    for (const ScriptInput& input : scene.script)
        if (const auto* spawn = std::get_if<SpawnAction>(&input.action))
            for (int i = 0; i < input.times; ++i) cast.push_back(spawnedBody(*spawn, i, input.times));
    return cast;
}

std::vector<BodyDescription> sceneCast(const Scene& scene) {
    std::vector<BodyDescription> cast = scriptedCast(scene);
    for (const LiveInput& input : scene.inputs)
        if (const BodyDescription* body = bodyPutBy(input.action)) cast.push_back(*body);
    return cast;
}

std::size_t bodyOfFixture(const std::vector<BodyDescription>& cast, int fixture) noexcept {
    if (fixture < 0) return cast.size();
    auto left = static_cast<std::size_t>(fixture);
    std::size_t body = 0;
    while (body < cast.size() && left >= cast[body].fixtures.size()) left -= cast[body++].fixtures.size();
    return body;
}

} // namespace physvib
