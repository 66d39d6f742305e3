// SPDX-License-Identifier: MIT
// Fuzz target of the scene reader: whatever it accepts can be written, read again and simulated.
#include "Fuzzing.h"
#include "Scene/SceneFile.h"
#include "Scene/World/SceneWorld.h"

namespace {

// Box2D asserts what it needs; so many steps that script and contacts come into play.
void simulate(const physvib::Scene& scene) {
    constexpr int steps = 4;
    physvib::SceneWorld world(scene, 1, {10});
    for (int step = 0; step < steps; ++step) {
        world.executeActions(step);
        world.world().Step(0.1F, 8, 3);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](auto text, auto name) { return readScene(text, name); };
    if (const auto scene = fuzz::tried(data, size, read, sceneJson)) simulate(*scene);
    return 0;
}
