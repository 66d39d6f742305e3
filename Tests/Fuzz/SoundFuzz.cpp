// SPDX-License-Identifier: MIT
// Fuzz target of what reads sounds: our head of them, and libsndfile behind it.
#include "Fuzzing.h"
#include "Live/Recordings/ReadRecording.h"
#include <algorithm>
#include <memory>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    if (size == 0) return 0;
    // only read
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(
        fmemopen(const_cast<std::uint8_t*>(data), size, "rb"), std::fclose);
    SoundBuffer keeper;
    const auto fault = decodeSound(*file, static_cast<std::int64_t>(size), 10, keeper);
    std::size_t frames = 0;
    for (const auto& channel : keeper.sound.channels) frames = std::max(frames, channel.size());
    fuzz::demand(!fault.empty() || frames > 0, "neither read nor refused", fault);
    for (const auto& channel : keeper.sound.channels)
        fuzz::demand(!fault.empty() || channel.size() == frames, "half-loaded", fault);
    return 0;
}
