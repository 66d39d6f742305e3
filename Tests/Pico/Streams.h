// SPDX-License-Identifier: MIT
// Streams for the Pico's signal path on this computer: a player that is fed, and what leaves it.
#pragma once
#include "Signal/Player.h"
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace physvib::test {

template <int channels>
class Stream {
public:
    using Frame = pico::Frame<channels>;
    using Source = std::function<std::int16_t(std::int64_t frame, int channel)>;

    explicit Stream(bool isCeilingLow = false)
        : player(std::make_unique<pico::Player<channels>>()) {
        player->setLowCeiling(isCeilingLow);
        for (int j = 0; j < channels; ++j) player->setVolume(j, pico::unity);
        tiles(300); // volumes and ceiling have ramped up
        out.clear();
    }

    void packet(const Source& source, int frames = 48) {
        std::vector<Frame> packet(static_cast<std::size_t>(frames));
        for (auto& frame : packet) {
            for (int j = 0; j < channels; ++j) frame[static_cast<std::size_t>(j)] = source(sent, j);
            ++sent;
        }
        player->buffer.write(packet.data(), static_cast<std::uint32_t>(frames));
    }
    /// A packet of 48 frames each millisecond, and the tiles of that time.
    void play(const Source& source, int milliseconds) {
        for (int k = 0; k < milliseconds; ++k) packet(source), tiles(3);
    }
    void tiles(int count) {
        for (int k = 0; k < count; ++k) {
            if (isAttended) player->setAllowed(isAllowed);
            pico::Tile<channels> tile;
            player->render(tile);
            out.insert(out.end(), tile.begin(), tile.end());
        }
    }
    std::vector<float> channel(std::size_t j) const {
        std::vector<float> samples;
        for (const auto& frame : out) samples.push_back(static_cast<float>(frame[j]) / 32768.0f);
        return samples;
    }

    std::unique_ptr<pico::Player<channels>> player;
    bool isAllowed = true;  ///< what the main loop says
    bool isAttended = true; ///< whether it says anything
    std::vector<Frame> out; ///< since the start
    std::int64_t sent = 0;
};

/// A tone of a frequency of its own per channel.
inline std::int16_t tone(std::int64_t frame, int channel) {
    const double hz = 100.0 + 50.0 * channel;
    return static_cast<std::int16_t>(
        std::lround(12000.0 * std::sin(6.283185307179586 * hz * static_cast<double>(frame) / 48000.0)));
}

} // namespace physvib::test
