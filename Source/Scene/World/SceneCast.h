// SPDX-License-Identifier: MIT
// All bodies that a scene can have, numbered as in the fixture numbers of events.
#pragma once
#include "Scene/Scene.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Body `repetition` (from 0) of a spawn: "stone 3" where the input has several times, else "stone".
BodyDescription spawnedBody(const SpawnAction& spawn, int repetition, int times);

/// Scene::bodies, then what the script spawns, in its order. The scene must be valid (or its repetitions
/// few). Any thread.
std::vector<BodyDescription> scriptedCast(const Scene& scene);

/// The same and what live inputs spawn or change, in their order. Fixture numbers in events count through the
/// fixtures of this list.
std::vector<BodyDescription> sceneCast(const Scene& scene);

/// Index of the body that has this fixture number; cast.size() if none has. Any thread.
std::size_t bodyOfFixture(const std::vector<BodyDescription>& cast, int fixture) noexcept;

} // namespace physvib
