// SPDX-License-Identifier: MIT
// Fuzz target of the library for other languages: calls in any order with anything are answered by a code.
#include "Support/RandomCalls.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static physvib::test::RandomCalls calls; // a renderer is megabytes: they go on from one input to the next
    calls.run(data, size);
    return 0;
}
