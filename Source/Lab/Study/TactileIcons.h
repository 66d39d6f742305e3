// SPDX-License-Identifier: MIT
// Selects the stimuli that participants confused least, for use as tactile icons (thesis 3.2.3).
#pragma once
#include "Lab/Study/ConfusionMatrix.h"
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace physvib {

/// Bits needed for that number of meanings: log2. Any thread.
inline double bitsFor(std::size_t meanings) noexcept {
    return meanings > 1 ? std::log2(static_cast<double>(meanings)) : 0.0;
}

/// Share of the stimulus' trials that were answered correctly. Any thread.
inline double shareCorrect(const ConfusionMatrix& matrix, std::size_t stimulus) {
    std::uint64_t total = 0;
    for (std::size_t j = 0; j < matrix.responses(); ++j) total += matrix.count(stimulus, j);
    return total > 0 ? static_cast<double>(matrix.count(stimulus, stimulus)) / static_cast<double>(total)
                     : 0.0;
}

/// Indices (ascending) of `count` stimuli, or of all if there are fewer. The most confused stimulus is
/// removed until `count` remain. Confusion of two stimuli is the sum of the shares of trials in which one was
/// answered with the other. Ties remove the stimulus with fewer correct answers, then the later one. Any
/// thread (allocates).
inline std::vector<std::size_t> leastConfused(const ConfusionMatrix& matrix, std::size_t count) {
    const auto totals = matrix.stimulusTotals();
    const auto confusion = [&](std::size_t a, std::size_t b) {
        return matrix.count(a, b) / static_cast<double>(totals[a]) +
               matrix.count(b, a) / static_cast<double>(totals[b]);
    };
    std::vector<std::size_t> left(matrix.stimuli());
    std::iota(left.begin(), left.end(), 0u);
    std::vector<double> with(matrix.stimuli(), 0.0);
    for (const std::size_t a : left)
        for (const std::size_t b : left)
            if (a != b) with[a] += confusion(a, b);
    while (left.size() > count) {
        const auto better = [&](std::size_t a, std::size_t b) {
            constexpr double rounding = 1e-9;
            if (std::abs(with[a] - with[b]) > rounding) return with[a] < with[b];
            const double ownA = shareCorrect(matrix, a), ownB = shareCorrect(matrix, b);
            return ownA != ownB ? ownA > ownB : a < b;
        };
        const auto worst = std::ranges::max_element(left, better);
        const std::size_t dropped = *worst;
        left.erase(worst);
        for (const std::size_t a : left) with[a] -= confusion(a, dropped);
    }
    return left;
}

} // namespace physvib
