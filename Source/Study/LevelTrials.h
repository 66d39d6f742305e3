// SPDX-License-Identifier: MIT
// Levels and magnitudes: what staircases, adjustments and magnitude estimations came to.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace physvib {

/// One trial of a staircase, an adjustment or a magnitude estimation.
struct LevelTrial {
    enum class Kind { staircase, adjustment, magnitude };
    Kind kind = Kind::staircase;
    std::string participant, condition, stimulus;
    double levelDb = 0.0; ///< staircase: of the trial
    double value = 0.0;   ///< adjustment: dB; magnitude: > 0
};

struct LevelSummary {
    LevelTrial::Kind kind = LevelTrial::Kind::staircase;
    std::string condition, stimulus; ///< stimulus empty: of a staircase, which has them all
    std::size_t trials = 0, participants = 0;
    std::size_t reversals = 0;   ///< staircase: all participants'
    double estimate = 0.0;       ///< staircase: mean threshold in dB; adjustment: mean dB; magnitude: geometric mean
    double deviation = 0.0;      ///< sample standard deviation, of participants' thresholds, of dB, or of log10; 0 for one
};

/// By kind, condition and stimulus, in this order. A participant's threshold is the mean level of the
/// later half of the reversals that the levels show (Levitt 1971), of the last trial if there are fewer than two. Any thread.
std::vector<LevelSummary> summariseLevels(const std::vector<LevelTrial>& trials);

} // namespace physvib
