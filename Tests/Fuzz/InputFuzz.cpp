// SPDX-License-Identifier: MIT
// Fuzz target of live input lines; what is accepted acts on a small world.
#include "Fuzzing.h"
#include "Live/Documents/InputLine.h"
#include "Scene/SceneFile.h"
#include "Scene/World/InputCheck.h"
#include "Scene/World/Simulation.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    static const Scene scene = *findBuiltInScene("drop");
    const auto read = readInputLine(fuzz::asText(data, size), scene.materials, 4);
    if (!read) {
        fuzz::demandClearRefusal(Result<LineInput>{Failure{"f: " + read.error}}, true);
        return 0;
    }
    const auto* action = std::get_if<Action>(&read.value);
    if (action == nullptr || !InputCheck(scene).accept(*action).empty()) return 0;
    Simulation world(scene, 1, 100);
    world.addInput(0.0, *action);
    std::vector<CollisionEvent> events;
    for (int step = 0; step < 5; ++step) world.step(events);
    return 0;
}
