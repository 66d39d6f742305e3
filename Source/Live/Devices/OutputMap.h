// SPDX-License-Identifier: MIT
// Assigns device outputs to actuators and to listeners.
#pragma once
#include "Core/Actuators/GainRamp.h"
#include "Core/Limits.h"
#include "Live/Devices/AudioDevice.h"
#include <array>
#include <atomic>
#include <string>
#include <vector>

namespace physvib {

/// Sources on outputs that drive no actuator: noise and contact sounds for listeners, which may share an
/// output, and marks for measuring devices.
enum class Heard { noise, contacts, marks };
constexpr std::size_t heardKinds = 3;

/// Device outputs from 0, per Heard.
using HeardOutputs = std::array<std::vector<int>, heardKinds>;

/// M, except at() (any thread) and play() (R).
class OutputMap {
public:
    OutputMap() {
        for (auto& at : at_) at = -1;
        for (auto& source : heardAt_)
            for (auto& at : source) at = -1;
        playing_.fill(-1);
    }

    /// Requests that actuator j play on device output wanted[j], from 0. With an empty list it is j;
    /// actuators beyond the list get none. `felt` of them are to be driven (0: all); `heard` are the
    /// listening outputs. Refused are two actuators on one output, whose sum could exceed its ceiling, an
    /// actuator on a listening output, and marks on either. Returns empty, or one line with the reason, in
    /// which case nothing changes. place() applies the request.
    std::string want(int enchanters, const std::vector<int>& wanted, int felt = 0,
                     const HeardOutputs& heard = {});

    /// Which of the `offered` outputs are wanted.
    ChannelSet outputs(int offered) const;

    /// The highest output with a listener; -1: none.
    int highestHeard() const noexcept;

    /// Applies the request. A callback gets the `active` outputs only, packed together.
    void place(const ChannelSet& active);

    /// Ends all fades: every actuator plays where it is placed. M, while R does not run.
    void settle(int sampleRateHz) noexcept;

    /// Processes the next `frames` samples of an actuator in place. If its output has changed, it fades out
    /// (limits::channelRampSeconds) and then in on the new output, once no other actuator plays there.
    /// Returns the callback channel to play on; -1: none. R, wait-free.
    int play(int enchanter, float* samples, int frames) noexcept;

    /// Callback channel of an actuator; -1: none.
    int at(int enchanter) const noexcept {
        return at_[static_cast<std::size_t>(enchanter)].load(std::memory_order_relaxed);
    }

    /// Callback channel of the i-th output of `source`; -1: none, or i is too large.
    int heardAt(Heard source, int i) const noexcept {
        return heardAt_[static_cast<std::size_t>(source)][static_cast<std::size_t>(i)].load(
            std::memory_order_relaxed);
    }
    static constexpr int mostHeard = 8; ///< outputs per source: four pairs of headphones

    int enchanters() const noexcept { return felt_; } ///< number that are to be driven
    int unfelt() const noexcept; ///< of these: without a callback channel, though the map does not say -1

private:
    std::vector<int> wanted_; // per actuator; -1: no output, -2: not specified
    int felt_ = 0;
    HeardOutputs heard_;
    std::array<std::atomic<int>, limits::maxEnchanters> at_{};
    std::array<std::array<std::atomic<int>, mostHeard>, heardKinds> heardAt_{};

    // R; set while R does not run
    std::array<int, limits::maxEnchanters> playing_; // as at_, delayed by the fades
    std::array<GainRamp, limits::maxEnchanters> ramps_;
};

} // namespace physvib
