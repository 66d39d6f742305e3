// SPDX-License-Identifier: MIT
// Which stimuli to give meanings to: those that people confused least (thesis 3.2.3, implications to
// applications).
#pragma once
#include "Lab/Study/ConfusionMatrix.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Bits that so many meanings need: log2. Any thread.
double bitsFor(std::size_t meanings) noexcept;

/// Stimuli (indices of the matrix, ascending), `count` of them or all if there are fewer: the most confused
/// one is dropped until as many are left. Confusion of two stimuli is the share of either one's trials
/// answered with the other; of equals the one with fewer correct answers goes, then the later one. Any thread
/// (allocates).
std::vector<std::size_t> leastConfused(const ConfusionMatrix& matrix, std::size_t count);

/// The share of the stimulus' trials that were answered with it. Any thread.
double shareCorrect(const ConfusionMatrix& matrix, std::size_t stimulus);

} // namespace physvib
