// SPDX-License-Identifier: MIT
// Selects the stimuli that participants confused least, for use as tactile icons (thesis 3.2.3).
#pragma once
#include "Lab/Study/ConfusionMatrix.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Bits needed for that number of meanings: log2. Any thread.
double bitsFor(std::size_t meanings) noexcept;

/// Indices (ascending) of `count` stimuli, or of all if there are fewer. The most confused stimulus is
/// removed until `count` remain. Confusion of two stimuli is the sum of the shares of trials in which one was
/// answered with the other. Ties remove the stimulus with fewer correct answers, then the later one. Any
/// thread (allocates).
std::vector<std::size_t> leastConfused(const ConfusionMatrix& matrix, std::size_t count);

/// Share of the stimulus' trials that were answered correctly. Any thread.
double shareCorrect(const ConfusionMatrix& matrix, std::size_t stimulus);

} // namespace physvib
