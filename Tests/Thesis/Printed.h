// SPDX-License-Identifier: MIT
// What the thesis prints of its studies beside what its page shows (Lab/Thesis/ThesisPage.h), and a model of
// where its phantoms are felt: the place, blurred by a normal distribution, answered with the nearest point.
#pragma once
#include "Lab/Study/Identification.h"
#include "Lab/Thesis/ThesisPage.h"
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

namespace physvib::thesis {

inline constexpr double patternsPercentMean = 92.1; ///< 3.2.2, over conditions
inline constexpr double modelChosenPercent = 59.0;  ///< 5.2.2, all votes

/// 5.3.2: three of the eight methods are printed.
struct Rating {
    std::string_view method;
    std::array<double, 3> scores{}; ///< realism, harmony, liking
};
inline constexpr std::array ratings{Rating{"AV-FV-DRV", {76.4, 68.9, 71.2}},
                                    Rating{"AF-FF-DRV", {37.8, 43.5, 36.0}},
                                    Rating{"AF-FF-DRF", {36.1, 42.2, 36.1}}};

/// More for varied than for fixed, mean of the three scales: amplitude, frequency, decay rate (5.3.2).
inline constexpr double amplitudeGain = 8.0, frequencyGain = 23.2, decayGain = 2.0;
/// Means of the printed F(1, 19) of their scales (5.3.2; all are in printed-tests.R).
inline constexpr double amplitudeF = (13.8 + 10.87) / 2.0, frequencyF = (56.49 + 32.98 + 59.74) / 3.0,
                        decayF = 6.30;

/// How many took part in each study, by our protocol.
struct Participants {
    std::string_view protocol;
    int count = 0;
};
inline constexpr std::array participants{
    Participants{"patterns", 12}, Participants{"phantom-grids", 18}, Participants{"phantom-places", 16},
    Participants{"model-or-sound", 20}, Participants{"eight-methods", 20}};

/// Rows and columns of a square grid.
inline int linesOf(const Identification& one) {
    return static_cast<int>(std::lround(std::sqrt(one.stimuli)));
}

/// The blur of places that explains the exact shares of a configuration, PHONE or RING (4.1.2).
inline double printedBlur(std::string_view configuration) {
    std::vector<ExactShare> shares;
    for (const Identification& one : identifications)
        if (one.study == "phantom-grids" && one.condition.starts_with(configuration))
            shares.push_back({linesOf(one), one.percentCorrect / 100.0});
    return fitPlaceBlur(shares);
}

} // namespace physvib::thesis
