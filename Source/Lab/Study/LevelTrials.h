// SPDX-License-Identifier: MIT
// Levels and magnitudes: what staircases, adjustments and magnitude estimations came to.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace physvib {

/// One trial of a staircase, an adjustment, a magnitude estimation or QUEST+.
struct LevelTrial {
    enum class Kind { staircase, adjustment, magnitude, quest };
    Kind kind = Kind::staircase;
    std::string participant, condition, stimulus;
    double levelDb = 0.0;           ///< staircase, QUEST+: of the trial
    double value = 0.0;             ///< adjustment: dB; magnitude: > 0; QUEST+: 1 if it was right, else 0
    std::string session{}, quest{}; ///< QUEST+: the words of its plan (QuestMethod.h)
};

struct LevelSummary {
    LevelTrial::Kind kind = LevelTrial::Kind::staircase;
    std::string condition, stimulus; ///< stimulus empty: of a staircase or QUEST+, which have them all
    std::size_t trials = 0, participants = 0;
    std::size_t reversals = 0; ///< staircase: all participants'
    std::size_t flatRuns = 0;  ///< staircases with fewer than two reversals
    double estimate = 0.0;     ///< staircase, QUEST+: mean threshold in dB; adjustment: mean dB; magnitude:
                               ///< geometric mean
    double deviation = 0.0; ///< sample standard deviation, of participants' thresholds, of dB, or of log10; 0
                            ///< for one
    double halfInterval = 0.0; ///< of thresholds and adjustments, 95 %: over participants; of one by QUEST+
                               ///< of what is still possible; else 0
};

/// By kind, condition and stimulus, in this order. A participant's threshold is, by a staircase, the mean
/// level of the later half of the reversals that the levels show (Levitt 1971), of the last trial if there
/// are fewer than two; by QUEST+ the mean of what its answers leave possible, worked out again from levels
/// and answers. Of several sessions it is their mean. Any thread (allocates).
std::vector<LevelSummary> summariseLevels(const std::vector<LevelTrial>& trials);

} // namespace physvib
