// SPDX-License-Identifier: MIT
// A USB host whose clock differs from the Pico's: it sends what it is asked for, in whole frames.
#pragma once
#include "Streams.h"
#include <cstdint>

namespace physvib::test {

/// Sends a packet per millisecond of the host. Calls `seen(millisecond, frames of the packet, level of the
/// buffer behind it)`.
template <class Seen>
void playByHostClock(Stream<4>& stream, double partsPerMillion, int milliseconds, Seen&& seen) {
    pico::Feedback feedback;
    auto& player = *stream.player;
    double due = 0.0, tiles = 0.0;
    std::uint32_t asked = pico::Feedback::nominal;
    for (int ms = 0; ms < milliseconds; ++ms) {
        due += asked / 65536.0;
        const int frames = static_cast<int>(due);
        due -= frames;
        stream.packet(tone, frames);
        asked = feedback.next(player.buffer.level(), player.buffer.targetFrames, player.isPlaying());
        seen(ms, frames, player.buffer.level());
        for (tiles += 3.0 * (1.0 + partsPerMillion * 1e-6); tiles >= 1.0; tiles -= 1.0) stream.tiles(1);
        stream.out.clear();
    }
}

} // namespace physvib::test
