// SPDX-License-Identifier: MIT
// Fuzz target of the reader of game controllers' profiles.
#include "Fuzzing.h"
#include "Scene/PadFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto profile = fuzz::tried(data, size, readPad, padJson);
    fuzz::demand(!profile || profile->law.low.threshold < profile->law.low.full, "a motor without a range");
    return 0;
}
