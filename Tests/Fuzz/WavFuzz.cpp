// SPDX-License-Identifier: MIT
// Fuzz target of the WAV reader.
#include "Fuzzing.h"
#include "Support/ReadWav.h"
#include <memory>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    if (size == 0) return 0;
    // only read
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        fmemopen(const_cast<std::uint8_t*>(data), size, "rb"), std::fclose);
    const auto sound = readWav(*file);
    fuzz::demand(static_cast<bool>(sound) != sound.value.channels.empty(), "half-loaded", sound.error);
    std::size_t samples = 0;
    for (const auto& channel : sound.value.channels) samples += channel.size();
    fuzz::demand(samples <= size, "more samples than bytes", sound.error);
    return 0;
}
