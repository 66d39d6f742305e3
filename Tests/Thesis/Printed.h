// SPDX-License-Identifier: MIT
// What the thesis prints of its studies beside what its page shows (Lab/Thesis/ThesisPage.h).
#pragma once
#include "Lab/Thesis/ThesisPage.h"
#include "Thesis/PlaceBlur.h"

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
