// SPDX-License-Identifier: MIT
// Output guard of the four-channel board against slow signals: applies GuardLaw to the converter codes that
// were sent, once per block.
//
// It sums codes, not samples, so that the converters' rounding is included. It is the board's only guard, so
// it uses the bounds of GuardPlace::last. Deciding per block (half a millisecond) costs more than per two
// blocks, but lets full scale pass unchanged from 31 Hz on, as on a computer; with two blocks it would be 37
// Hz.
#pragma once
#include "Core/Actuators/GuardLaw.h"
#include "Core/Modes/PhasorBank.h"

namespace physvib {

/// Render thread (R) only; prepare: message thread (M).
class BoardGuard {
public:
    static constexpr int channels = PhasorBank::channels;
    using Areas = GuardLaw<channels>::Row;

    /// Resets the sums. M, not while rendering.
    void prepare() noexcept {
        law_.prepare(channels, GuardPlace::last);
        law_.setTile(blockSeconds);
        acts_ = false;
    }

    /// True if the gain of the next block has to be reduced.
    bool acts() const noexcept { return acts_; }
    /// Not inlined: it runs seldom, so a board keeps it out of its fast memory.
    [[gnu::noinline]] void turnDown(PhasorBank::Block& io) const noexcept {
        for (std::size_t j = 0; j < io.size(); ++j) {
            const float step = (law_.to(j) - law_.from(j)) / PhasorBank::blockFrames;
            float gain = law_.from(j);
            for (float& sample : io[j]) sample *= gain += step;
        }
    }

    /// Area of one channel in a block, from the sum of its codes above mid-scale.
    static constexpr float area(int sum) noexcept {
        return static_cast<float>(sum) * (1.0f / (fullScale * limits::board::sampleRateHz));
    }
    /// Takes the areas of a block that was sent and decides about the next one.
    void take(const Areas& areas) noexcept { acts_ = law_.take(areas); }

    /// The next block is played unchanged; for a block that is not sent.
    void letThrough() noexcept { acts_ = false; }

    float gain() const noexcept { return law_.gain(); }                 ///< lowest gain of all channels
    std::uint32_t episodes() const noexcept { return law_.episodes(); } ///< how often it began to act

    static constexpr float fullScale = 127.0f; ///< in steps of the converters
    static constexpr float blockSeconds =
        static_cast<float>(PhasorBank::blockFrames) / limits::board::sampleRateHz;

private:
    GuardLaw<channels> law_;
    bool acts_ = false;
};

} // namespace physvib
