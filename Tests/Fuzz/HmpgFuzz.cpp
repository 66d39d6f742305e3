// SPDX-License-Identifier: MIT
// Fuzz target of the reader of .hmpg files.
#include "ClipFuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    physvib::fuzz::tryClip(physvib::fuzz::asText(data, size), physvib::ClipFormat::hmpg);
    return 0;
}
