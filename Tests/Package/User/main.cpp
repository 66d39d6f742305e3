// SPDX-License-Identifier: MIT
// One hit on two outputs, beside a Core/Limits.h of the user's own.
#include "Core/Limits.h"
#include <algorithm>
#include <array>
#include <iostream>
#include <memory>
#include <physvib/Core/HapticRenderer.h>
#include <physvib/Version.h>

static_assert(PHYSVIB_VERSION_MAJOR * 100 + PHYSVIB_VERSION_MINOR >= 1, "expected a version");

int main() {
    physvib::ActuatorLayout layout;
    physvib::layoutPreset("phone2", layout);
    const auto renderer = std::make_unique<physvib::HapticRenderer>();
    if (!renderer->prepare(
            {.channels = user::outputs, .panner = {layout, physvib::PanningLaw::linear, 1.0, 1.0, 1.0}}))
        return 1;
    physvib::EventQueue<physvib::CollisionEvent, 4> queue;
    physvib::CollisionEvent hit;
    hit.frequencyHz = 200.0;
    hit.decayPerSecond = 30.0;
    hit.amplitude = 0.5;
    queue.push(hit);
    std::array<std::array<float, 480>, user::outputs> out;
    std::array<float*, user::outputs> channels{out[0].data(), out[1].data()};
    renderer->render(queue, channels.data(), 480);
    std::cout << PHYSVIB_VERSION << ": peak " << *std::max_element(out[0].begin(), out[0].end()) << '\n';
}
