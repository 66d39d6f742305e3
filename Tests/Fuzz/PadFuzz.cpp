// SPDX-License-Identifier: MIT
// Fuzz target of the reader of game controllers' profiles.
#include "Fuzzing.h"
#include "Scene/PadFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readPad(text, "f"); };
    const auto profile = read(fuzz::asText(data, size));
    if (!profile) {
        fuzz::demandClearRefusal(profile, profile.value == PadProfile{});
        return 0;
    }
    fuzz::demand(profile.value.law.low.threshold < profile.value.law.low.full, "a motor without a range");
    fuzz::demandRoundTrip(padJson(profile.value), read, padJson);
    return 0;
}
