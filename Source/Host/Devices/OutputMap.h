// SPDX-License-Identifier: GPL-3.0-or-later
// Which output of a device is which enchanter, and which ones somebody listens to.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include <array>
#include <atomic>
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// What else is played, on outputs that are no enchanter's: noise and contacts for ears, which may share one,
/// and marks for machines.
enum class Heard { noise, contacts, marks };
constexpr std::size_t heardKinds = 3;

/// Device outputs from 0, per Heard.
using HeardOutputs = std::array<std::vector<int>, heardKinds>;

/// M, but for at(), any thread, and play(), R.
class OutputMap {
public:
    OutputMap() {
        for (auto& at : at_) at = -1;
        for (auto& source : heardAt_)
            for (auto& at : source) at = -1;
        playing_.fill(-1);
    }

    /// Enchanter j is wanted on device output wanted[j], from 0; with an empty list on j; those not in the
    /// list on none. `felt` of them are to be felt (0: all); `heard` is listened to. Refuses two enchanters
    /// on one output, which would add up beyond its ceiling, an enchanter on one that is listened to, and
    /// marks on either: empty, or one line with the reason, and all is as before. place() makes it so.
    std::string want(int enchanters, const std::vector<int>& wanted, int felt = 0,
                     const HeardOutputs& heard = {});

    /// Those of the `offered` outputs that are wanted.
    juce::BigInteger outputs(int offered) const;

    /// The highest output that is listened to; -1: none.
    int highestHeard() const noexcept;

    /// A callback gets the `active` outputs only, packed together.
    void place(const juce::BigInteger& active);

    /// All play where they are placed, at once. M, while R does not run.
    void settle(int sampleRateHz) noexcept;

    /// The next `frames` samples of an enchanter, in place: where it is placed elsewhere, it fades out
    /// (limits::channelRampSeconds) and then in over there, once nobody else plays there. The callback
    /// channel they are for; -1: none. R, wait-free.
    int play(int enchanter, float* samples, int frames) noexcept;

    /// Callback channel of an enchanter; -1: it has none.
    int at(int enchanter) const noexcept {
        return at_[static_cast<std::size_t>(enchanter)].load(std::memory_order_relaxed);
    }

    /// Callback channel of the i-th output of `source`; -1: it has none, or there are no more.
    int heardAt(Heard source, int i) const noexcept {
        return heardAt_[static_cast<std::size_t>(source)][static_cast<std::size_t>(i)].load(
            std::memory_order_relaxed);
    }
    static constexpr int mostHeard = 8; ///< outputs per source: four pairs of headphones

    int enchanters() const noexcept { return felt_; } ///< that are to be felt
    int unfelt() const noexcept; ///< of these: without a callback channel, though nobody said -1

private:
    std::vector<int> wanted_; // per enchanter; -1: nowhere, -2: nobody said where
    int felt_ = 0;
    HeardOutputs heard_;
    std::array<std::atomic<int>, limits::maxEnchanters> at_{};
    std::array<std::array<std::atomic<int>, mostHeard>, heardKinds> heardAt_{};

    // R, set while it does not run
    std::array<int, limits::maxEnchanters> playing_; // as at_, behind it by the fades
    std::array<GainRamp, limits::maxEnchanters> ramps_;
};

} // namespace physvib
