// SPDX-License-Identifier: MIT
// Start values for overlapping partials by linear prediction (Prony 1795).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

struct PredictedPartial {
    double omega = 0.0, tau = 0.0; ///< rad/s, 1/s
};

/// Frequencies and decays of `partials` decaying sinusoids; exact if the samples are so many sinusoids
/// without noise. Computed from the means of `blocks` blocks of equal length: the means of a decaying
/// sinusoid are one of the same frequency and decay. Fewer results if the roots are not conjugate pairs, none
/// if there are too few samples. `samples` begin after the onset. Message thread (M) only.
std::vector<PredictedPartial> predictPartials(std::span<const double> samples, double rateHz,
                                              std::size_t partials, std::size_t blocks);

} // namespace physvib
