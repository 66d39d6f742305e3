// SPDX-License-Identifier: GPL-3.0-or-later
// Which output of a device is which enchanter.
#pragma once
#include "Core/Limits.h"
#include <array>
#include <atomic>
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// M, but for at(): any thread.
class OutputMap {
public:
    OutputMap() {
        for (auto& at : at_) at = -1;
    }

    /// Enchanter j is wanted on device output wanted[j], from 0; with an empty list on j; those not in the list on none. `felt`
    /// of them are to be felt (0: all). Refuses two enchanters on one
    /// output, which would add up beyond its ceiling: empty, or one line with the reason, and all is as before. place()
    /// makes it so.
    std::string want(int enchanters, const std::vector<int>& wanted, int felt = 0);

    /// Those of the `offered` outputs that are wanted.
    juce::BigInteger outputs(int offered) const;

    /// A callback gets the `active` outputs only, packed together.
    void place(const juce::BigInteger& active);

    /// Callback channel of an enchanter; -1: it has none.
    int at(int enchanter) const noexcept { return at_[static_cast<std::size_t>(enchanter)].load(std::memory_order_relaxed); }

    int enchanters() const noexcept { return felt_; } ///< that are to be felt
    int unfelt() const noexcept; ///< of these: without a callback channel

private:
    std::vector<int> wanted_; // per enchanter; -1: nowhere
    int felt_ = 0;
    std::array<std::atomic<int>, limits::maxEnchanters> at_{};
};

} // namespace physvib
