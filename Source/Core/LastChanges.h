// SPDX-License-Identifier: MIT
// The last changes of a renderer, to explain why it is silent.
#pragma once
#include "Core/RenderControl.h"
#include <cstdint>

namespace physvib {

/// Of all controls so far, also those that take effect later. One thread at a time.
struct LastChanges {
    PhantomPanner panner;
    double level = 1.0;
    std::int64_t silentUntilNs = 0;
    std::uint64_t muted = 0, zeroGains = 0; ///< bit j: channel j

    std::uint64_t mutedChannels() const noexcept { return muted | zeroGains; } ///< those that play nothing

    void take(const RenderControl& control) noexcept {
        using Kind = RenderControl::Kind;
        const std::uint64_t bit = std::uint64_t{1} << (static_cast<unsigned>(control.channel) % 64U);
        if (control.kind == Kind::panner && control.panner != nullptr) panner = *control.panner;
        if (control.kind == Kind::level) level = static_cast<double>(control.value);
        if (control.kind == Kind::silence) silentUntilNs = control.untilNs;
        if (control.kind == Kind::mute) muted = control.value != 0.0F ? muted | bit : muted & ~bit;
        if (control.kind == Kind::gain) zeroGains = control.value > 0.0F ? zeroGains & ~bit : zeroGains | bit;
    }
};

} // namespace physvib
