// SPDX-License-Identifier: MIT
// Pink noise for headphones, which masks the sound of the actuators (thesis 3.2.1). It is played on
// other outputs than the stimuli.
#pragma once
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace physvib {

/// Noise with -3 dB per octave over sixteen octaves below half the sample rate, by the algorithm of Voss and
/// McCartney: the sum of rows of random numbers, of which row k changes every 2^(k+1) samples. Samples are
/// within -1 to 1, the same for the same seed. One thread at a time; next() is wait-free.
class PinkNoise {
public:
    /// RMS of the samples: the mean of seventeen independent numbers that are uniform from -1 to 1.
    static constexpr double rootMeanSquare = 0.14002800840280097; // 1 / sqrt(3 * 17)

    // RMS levels on headphones, in dB of full scale. The largest samples, 17.1 dB above, still fit at maxDb.
    static constexpr double minDb = -90.0, safeDb = -40.0, maxDb = -18.0;

    explicit PinkNoise(std::uint32_t seed = 1) noexcept
        : state_{seed * 2654435761u + 1u} {
        for (float& row : rows_) sum_ += row = white();
    }

    float next() noexcept {
        const auto row = static_cast<std::size_t>(std::countr_zero(++count_ | 1u << (rows_.size() - 1)));
        sum_ -= rows_[row];
        sum_ += rows_[row] = white();
        return (sum_ + white()) / static_cast<float>(rows_.size() + 1);
    }

private:
    /// From -1 to 1, in steps of 2^-15: their sums are exact, so the running sum does not drift.
    float white() noexcept {
        state_ ^= state_ << 13; // xorshift32 (Marsaglia 2003)
        state_ ^= state_ >> 17;
        state_ ^= state_ << 5;
        return static_cast<float>(static_cast<std::int32_t>(state_) >> 16) * 0x1p-15f;
    }

    std::uint32_t state_;
    std::uint32_t count_ = 0;
    std::array<float, 16> rows_{};
    float sum_ = 0.0f;
};

} // namespace physvib
