// SPDX-License-Identifier: MIT
// A model of where phantoms are felt: the place, blurred by a normal distribution, answered with the nearest
// point.
#pragma once
#include "Lab/Study/Identification.h"
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace physvib {

/// What the model says of a square grid on the corners.
struct BlurredGrid {
    double shareExact = 0.0;      ///< of right answers
    double shareTolerance1 = 0.0; ///< of answers at most one step off (Manhattan)
    double bits = 0.0;            ///< information transfer, exact
    double bitsTolerance1 = 0.0;  ///< the same with an answer at most one step off counted as right
};

namespace blurring { // rows and columns are answered independently, so one axis says all

inline double normalBelow(double x) noexcept { return 0.5 * std::erfc(-x / std::numbers::sqrt2); }

using Shares = std::vector<std::vector<double>>; // [target][answer]

inline Shares axisShares(int lines, double blur) {
    const auto n = static_cast<std::size_t>(lines);
    Shares shares(n, std::vector<double>(n));
    const double step = 1.0 / (lines - 1);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
            const double off = (static_cast<double>(j) - static_cast<double>(i)) * step;
            const double upTo = j + 1 == n ? 1.0 : normalBelow((off + 0.5 * step) / blur);
            shares[i][j] = upTo - (j == 0 ? 0.0 : normalBelow((off - 0.5 * step) / blur));
        }
    return shares;
}

/// IT of n x n equally likely targets; within `tolerance` an answer counts as its target.
inline double transfer(const Shares& axis, int tolerance) {
    const std::size_t n = axis.size(), cells = n * n;
    std::vector<std::vector<double>> joint(cells, std::vector<double>(cells, 0.0));
    std::vector<double> answers(cells, 0.0);
    for (std::size_t i = 0; i < cells; ++i)
        for (std::size_t j = 0; j < cells; ++j) {
            const GridCell target{static_cast<int>(i / n), static_cast<int>(i % n)},
                answer{static_cast<int>(j / n), static_cast<int>(j % n)};
            const double share = axis[i / n][j / n] * axis[i % n][j % n] / static_cast<double>(cells);
            const std::size_t counted = manhattanDistance(target, answer) <= tolerance ? i : j;
            joint[i][counted] += share;
            answers[counted] += share;
        }
    double bits = 0.0;
    for (std::size_t i = 0; i < cells; ++i)
        for (std::size_t j = 0; j < cells; ++j)
            if (joint[i][j] > 0.0)
                bits += joint[i][j] * std::log2(joint[i][j] * static_cast<double>(cells) / answers[j]);
    return bits;
}

} // namespace blurring

/// `blur`: standard deviation in x and y, as a share of the field's width and height, > 0. Any thread.
inline BlurredGrid blurredGrid(int lines, double blur) {
    const blurring::Shares axis = blurring::axisShares(lines, blur);
    double same = 0.0, beside = 0.0;
    for (std::size_t i = 0; i < axis.size(); ++i) {
        same += axis[i][i] / lines;
        if (i > 0) beside += axis[i][i - 1] / lines;
        if (i + 1 < axis.size()) beside += axis[i][i + 1] / lines;
    }
    return {same * same, same * same + 2.0 * same * beside, blurring::transfer(axis, 0),
            blurring::transfer(axis, 1)};
}

/// A measured share of exact answers on a grid of lines x lines.
struct ExactShare {
    int lines = 0;
    double share = 0.0;
};

namespace blurring {

inline double squaredError(std::span<const ExactShare> measured, double blur) {
    double sum = 0.0;
    for (const ExactShare& m : measured) {
        const Shares axis = axisShares(m.lines, blur);
        double exact = 0.0;
        for (std::size_t i = 0; i < axis.size(); ++i) exact += axis[i][i] / m.lines;
        sum += (exact * exact - m.share) * (exact * exact - m.share);
    }
    return sum;
}

} // namespace blurring

/// The blur whose exact shares come nearest to the measured ones (least squares), within a ten-thousandth of
/// the field. Any thread (allocates).
inline double fitPlaceBlur(std::span<const ExactShare> measured) {
    double best = 0.05, width = 0.05;
    for (double blur = 0.01; blur < 1.0; blur += 0.01)
        if (blurring::squaredError(measured, blur) < blurring::squaredError(measured, best)) best = blur;
    for (width = 0.01; width > 0.5e-4; width *= 0.5) // the error has one minimum between the neighbours
        for (const double blur : {best - width, best + width})
            if (blur > 0.0 && blurring::squaredError(measured, blur) < blurring::squaredError(measured, best))
                best = blur;
    return best;
}

} // namespace physvib
