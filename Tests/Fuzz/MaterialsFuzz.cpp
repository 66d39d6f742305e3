// SPDX-License-Identifier: MIT
// Fuzz target of the material library's reader.
#include "Fuzzing.h"
#include "Scene/MaterialTable.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    physvib::fuzz::tried(data, size, physvib::readMaterials, physvib::materialsJson);
    return 0;
}
