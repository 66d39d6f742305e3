// SPDX-License-Identifier: MIT
// Start values for partials that overlap: samples predicted from the samples before them (Prony 1795).
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

struct PredictedPartial {
    double omega = 0.0, tau = 0.0; ///< rad/s, 1/s
};

/// Frequencies and decays of `partials` decaying sinusoids, exact if there are that many and no noise, from
/// the means of `blocks` blocks of equal length: a mean of a decaying sinusoid is one of the same frequency
/// and decay. Fewer if the prediction's roots are no such pairs, none if there is too little. `samples` begin
/// after the onset. M only.
std::vector<PredictedPartial> predictPartials(std::span<const double> samples, double rateHz,
                                              std::size_t partials, std::size_t blocks);

} // namespace physvib
