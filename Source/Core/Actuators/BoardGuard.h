// SPDX-License-Identifier: MIT
// The guard of the four-channel board: GuardLaw over the codes that leave, a decision per block.
//
// It counts codes, not samples, so that what the converters round is in its sums. The one guard there, so it
// has the bounds of the last. A decision per block (half a millisecond) costs more than one per two, but with
// it full scale passes as it is from 31 Hz on, as it does on a computer; with two it would be 37 Hz.
#pragma once
#include "Core/Actuators/GuardLaw.h"
#include "Core/Modes/PhasorBank.h"

namespace physvib {

/// R only, but for prepare: M.
class BoardGuard {
public:
    static constexpr int channels = PhasorBank::channels;
    using Areas = GuardLaw<channels>::Row;

    /// Nothing has left. M, not while rendering.
    void prepare() noexcept {
        law_.prepare(channels, GuardPlace::last);
        law_.setTile(blockSeconds);
        acts_ = false;
    }

    /// True if the next block has to be turned down.
    bool acts() const noexcept { return acts_; }
    /// Seldom, so a board does not keep it in its fast memory.
    [[gnu::noinline]] void turnDown(PhasorBank::Block& io) const noexcept {
        for (std::size_t j = 0; j < io.size(); ++j) {
            const float step = (law_.to(j) - law_.from(j)) / PhasorBank::blockFrames;
            float gain = law_.from(j);
            for (float& sample : io[j]) sample *= gain += step;
        }
    }

    /// Of one channel in a block, from the sum of its codes above mid-scale.
    static constexpr float area(int sum) noexcept {
        return static_cast<float>(sum) * (1.0f / (fullScale * limits::board::sampleRateHz));
    }
    /// What has left in a block; then it decides about the next.
    void take(const Areas& areas) noexcept { acts_ = law_.take(areas); }

    /// The next block is played as it is. For a block that does not leave.
    void letThrough() noexcept { acts_ = false; }

    float gain() const noexcept { return law_.gain(); }                 ///< the least of all channels
    std::uint32_t episodes() const noexcept { return law_.episodes(); } ///< how often it began to act

    static constexpr float fullScale = 127.0f; ///< in steps of the converters
    static constexpr float blockSeconds =
        static_cast<float>(PhasorBank::blockFrames) / limits::board::sampleRateHz;

private:
    GuardLaw<channels> law_;
    bool acts_ = false;
};

} // namespace physvib
