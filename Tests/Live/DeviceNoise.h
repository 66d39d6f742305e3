// SPDX-License-Identifier: GPL-3.0-or-later
// What tests of devices play: samples that nothing may change, denormals and beyond full scale too.
#pragma once
#include "Live/Devices/AudioDevice.h"
#include <atomic>
#include <bit>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>

namespace physvib::test {

/// Sample of a frame, from 0, and a channel: all exponents but those of infinity.
inline float noise(std::uint32_t frame, int channel) {
    std::uint32_t x = (frame + 1) * 2654435761u ^ (static_cast<std::uint32_t>(channel) + 1) * 2246822519u;
    x = (x ^ x >> 15) * 3266489917u;
    x ^= x >> 13;
    const std::uint32_t exponent = x % 3 == 0 ? 0 : 100 + (x >> 8) % 28; // a third are denormal
    return std::bit_cast<float>((x & 0x807fffffu) | exponent << 23);
}

/// Plays noise() from the first block after each start.
struct NoiseUser final : AudioDeviceCallback {
    std::atomic<std::uint32_t> frames{0}, blocks{0};
    std::atomic<int> starts{0}, stops{0}, outputs{0}, longest{0};
    void aboutToStart(AudioDevice&) override { ++starts; }
    void stopped() override { ++stops; }
    void processBlock(const float* const*, int, float* const* out, int channels,
                      int count) noexcept override {
        const std::uint32_t first = frames;
        for (int j = 0; j < channels; ++j)
            for (int n = 0; n < count; ++n) out[j][n] = noise(first + static_cast<std::uint32_t>(n), j);
        frames = first + static_cast<std::uint32_t>(count);
        outputs = channels;
        if (count > longest) longest = count;
        ++blocks;
    }
};

inline std::unique_ptr<AudioDriver> driverNamed(const std::string& name) {
    for (auto& driver : systemAudioDrivers())
        if (driver->name() == name) return std::move(driver);
    return nullptr;
}

/// Waits up to ten seconds for it.
inline bool comes(const std::function<bool()>& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds{5});
    return condition();
}

} // namespace physvib::test
