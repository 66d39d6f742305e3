// SPDX-License-Identifier: MIT
// Fuzz target of the layout reader.
#include "Fuzzing.h"
#include "Scene/LayoutFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readLayout(text, "f"); };
    const auto layout = read(fuzz::asText(data, size));
    if (!layout) {
        fuzz::demandClearRefusal(layout, layout.value.enchanters.empty() && layout.value.geometry.count == 0);
        return 0;
    }
    fuzz::demand(isValid(layout.value.geometry), "not valid");
    fuzz::demandRoundTrip(layoutJson(layout.value), read, layoutJson);
    return 0;
}
