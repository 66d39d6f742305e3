// SPDX-License-Identifier: MIT
// Fuzz target of the plug-in's state, which hosts keep and may damage.
#include "Fuzzing.h"
#include "Live/Documents/PluginState.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readPluginState(text, "f"); };
    const auto state = read(fuzz::asText(data, size));
    if (!state) {
        fuzz::demandClearRefusal(state, state.value.scene == Scene{} && state.value.parameters.empty());
        return 0;
    }
    fuzz::demandRoundTrip(pluginStateJson(state.value), read, pluginStateJson);
    return 0;
}
