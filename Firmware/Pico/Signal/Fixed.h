// SPDX-License-Identifier: MIT
// Numbers that all parts of the Pico's signal path share. Integers alone: the chip has no floating point, and
// the same code gives the same bits on a computer, where its tests run.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace physvib::pico {

constexpr int sampleRateHz = 48000;
constexpr int tileFrames = 16; // a third of a millisecond: gains and the guard are decided once per tile
constexpr int tilesPerSecond = sampleRateHz / tileFrames;
constexpr std::int32_t unity = 32768; // gains are multiples of 2^-15; this one leaves every sample unchanged

/// A sample of each channel, as they come in USB packets. Aligned, so that the chip copies words.
template <int channels>
struct alignas(4) Frame : std::array<std::int16_t, static_cast<std::size_t>(channels)> {};
template <int channels>
using Tile = std::array<Frame<channels>, static_cast<std::size_t>(tileFrames)>;

/// Product of two gains from 0 to unity. Any thread.
constexpr std::int32_t times(std::int32_t a, std::int32_t b) noexcept {
    return a * b / unity; // 2^30 at most
}

} // namespace physvib::pico
