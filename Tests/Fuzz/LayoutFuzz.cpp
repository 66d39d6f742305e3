// SPDX-License-Identifier: MIT
// Fuzz target of the layout reader.
#include "Fuzzing.h"
#include "Scene/LayoutFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto layout = fuzz::tried(data, size, readLayout, layoutJson, [](const LayoutDescription& empty) {
        return empty.actuators.empty() && empty.geometry.count == 0;
    });
    fuzz::demand(!layout || isValid(layout->geometry), "not valid");
    return 0;
}
