// SPDX-License-Identifier: MIT
// Fuzz target of the plug-in's state, which hosts keep and may damage.
#include "Fuzzing.h"
#include "Live/Documents/PluginState.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    fuzz::tried(data, size, readPluginState, pluginStateJson,
                [](const PluginState& empty) { return empty.scene == Scene{} && empty.parameters.empty(); });
    return 0;
}
