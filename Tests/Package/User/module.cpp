// SPDX-License-Identifier: MIT
// A plug-in module of the user's: one entry point, and inside of it a renderer.
#include <memory>
#include <physvib/Core/HapticRenderer.h>

extern "C" __attribute__((visibility("default"))) int userEntry() {
    const auto renderer = std::make_unique<physvib::HapticRenderer>();
    return renderer->prepare({}) ? 1 : 0;
}
