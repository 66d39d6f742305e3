// SPDX-License-Identifier: MIT
// Proportion of trials with its confidence interval.
#pragma once
#include <cstdint>

namespace physvib {

struct Proportion {
    std::uint64_t hits = 0, trials = 0;
    double share = 0.0;             ///< hits / trials; 0 without a trial
    double least = 0.0, most = 1.0; ///< 95 % confidence interval (Wilson 1927), assuming independent trials
};

/// `hits` <= `trials`. Any thread.
Proportion proportion(std::uint64_t hits, std::uint64_t trials) noexcept;

} // namespace physvib
