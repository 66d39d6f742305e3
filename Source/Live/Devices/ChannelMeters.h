// SPDX-License-Identifier: MIT
// Meter values of the outputs, for the views of plug-in and mixer.
#pragma once
#include "Core/Limits.h"
#include <array>

namespace physvib {

struct ChannelMeters {
    std::array<float, limits::maxEnchanters> peaks{}; ///< 1 = full scale; falling by `meterFallDbPerSecond`
    std::array<bool, limits::maxEnchanters> isConnected{};
    int enchanters = 0;
    int connected = 0;
    float limiterGain = 1.0f;
    float guardGain = 1.0f; ///< of the channel that OutputGuard attenuates most
};

constexpr double meterFallDbPerSecond = 20.0;

} // namespace physvib
