// SPDX-License-Identifier: MIT
// Fuzz target of the material library's reader.
#include "Fuzzing.h"
#include "Scene/MaterialTable.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto read = physvib::readMaterials(physvib::fuzz::asText(data, size), "f");
    if (!read) physvib::fuzz::demandClearRefusal(read, physvib::fuzz::isDefault(read.value));
    return 0;
}
