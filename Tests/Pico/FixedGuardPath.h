// SPDX-License-Identifier: MIT
// The Pico's guard, for GuardAttack: a sample stands for a tile.
#pragma once
#include "Signal/FixedGuard.h"
#include "Support/GuardAttack.h"

namespace physvib::test {

inline GuardPath fixedGuardPath() {
    return {"Pico", pico::tilesPerSecond, [](std::vector<float> samples) {
                pico::FixedGuard<1> guard;
                for (float& x : samples) {
                    const double gain = double(guard.gainAtEnd(0)) / pico::unity;
                    const auto sample = static_cast<std::int32_t>(std::lround(32767.0 * double(x) * gain));
                    guard.update({sample * pico::tileFrames});
                    x = static_cast<float>(sample) / 32768.0f;
                }
                return samples;
            }};
}

} // namespace physvib::test
