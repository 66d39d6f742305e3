// SPDX-License-Identifier: MIT
// Fuzz target of the material library's reader.
#include "Fuzzing.h"
#include "Scene/MaterialTable.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readMaterials(text, "f"); };
    const auto table = read(fuzz::asText(data, size));
    if (!table) {
        fuzz::demandClearRefusal(table, table.value == MaterialTable{});
        return 0;
    }
    fuzz::demandRoundTrip(materialsJson(table.value), read, materialsJson);
    return 0;
}
