// SPDX-License-Identifier: MIT
// Converts a mode's frequency and decay to integer increments per frame, and to its life in frames.
#pragma once
#include "Core/Limits.h"
#include "Core/Trigonometry.h"
#include <cmath>
#include <cstdint>
#include <numbers>

namespace physvib {

/// Turns / 2^64 per frame. Any thread, as all functions here.
inline std::uint64_t phaseIncrementOf(double frequencyHz, double rate) noexcept {
    return static_cast<std::uint64_t>(frequencyHz / rate * 18446744073709551616.0);
}

/// Octaves / 2^56 per frame.
inline std::int64_t decayIncrementOf(double decayPerSecond, double rate) noexcept {
    return static_cast<std::int64_t>(decayPerSecond / rate * (std::numbers::log2e * octaveUnit) + 0.5);
}

/// Frames until the level has fallen by limits::retireDecibels; INT64_MAX if it does not decay.
inline std::int64_t lifeFramesOf(std::int64_t decayIncrement) noexcept {
    constexpr auto octaves = static_cast<std::int64_t>(
        limits::retireDecibels / (20.0 * (std::numbers::ln2 / std::numbers::ln10)) * octaveUnit);
    return decayIncrement == 0 ? INT64_MAX : octaves / decayIncrement + 1;
}

/// The phase, in turns / 2^64, of a tone that began at phase 0, after `turns` turns.
inline std::uint64_t phaseAfter(double turns) noexcept {
    return static_cast<std::uint64_t>((turns - std::floor(turns)) * 18446744073709551616.0);
}

/// The factor by which an amplitude has decayed after `seconds`.
inline double shareLeft(double decayPerSecond, double seconds) noexcept {
    const double octaves = decayPerSecond * seconds * std::numbers::log2e;
    return octaves < 120.0 ? decayFactor<double>(static_cast<std::int64_t>(octaves * octaveUnit)) : 0.0;
}

} // namespace physvib
