// SPDX-License-Identifier: GPL-3.0-or-later
// Which output of a device is which enchanter.
#pragma once
#include "Core/Limits.h"
#include <array>
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// M, but for at(): any thread while nothing changes.
class OutputMap {
public:
    /// Enchanter j is wanted on device output wanted[j], from 0; with an empty list on j. Refuses two enchanters on one
    /// output, which would add up beyond its ceiling: empty, or one line with the reason.
    std::string want(int enchanters, const std::vector<int>& wanted);

    /// Those of the `offered` outputs that are wanted.
    juce::BigInteger outputs(int offered) const;

    /// A callback gets the `active` outputs only, packed together.
    void place(const juce::BigInteger& active);

    /// Callback channel of an enchanter; -1: it has none.
    int at(int enchanter) const noexcept { return at_[static_cast<std::size_t>(enchanter)]; }

    int enchanters() const noexcept { return static_cast<int>(wanted_.size()); }
    int unfelt() const noexcept; ///< enchanters without a callback channel

private:
    std::vector<int> wanted_; // per enchanter; -1: nowhere
    std::array<int, limits::maxEnchanters> at_{};
};

} // namespace physvib
