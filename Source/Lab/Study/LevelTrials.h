// SPDX-License-Identifier: MIT
// Results of staircases, adjustments, magnitude estimations and QUEST+: thresholds, levels and magnitudes per
// condition.
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace physvib {

/// One trial of a staircase, an adjustment, a magnitude estimation or QUEST+.
struct LevelTrial {
    enum class Kind { staircase, adjustment, magnitude, quest };
    Kind kind = Kind::staircase;
    std::string participant, condition, stimulus;
    double levelDb = 0.0;           ///< staircase, QUEST+: level of the trial
    double value = 0.0;             ///< adjustment: dB; magnitude: > 0; QUEST+: 1 if correct, else 0
    std::string session{}, quest{}; ///< QUEST+: the text of its plan (QuestMethod.h)
};

struct LevelSummary {
    LevelTrial::Kind kind = LevelTrial::Kind::staircase;
    std::string condition, stimulus; ///< stimulus is empty for staircases and QUEST+, which pool all stimuli
    std::size_t trials = 0, participants = 0;
    std::size_t reversals = 0; ///< staircase: sum over participants
    std::size_t flatRuns = 0;  ///< staircases with fewer than two reversals
    double estimate = 0.0;     ///< staircase, QUEST+: mean threshold in dB; adjustment: mean dB; magnitude:
                               ///< geometric mean
    double deviation = 0.0; ///< sample standard deviation of participants' thresholds, of dB, or of log10; 0
                            ///< for one value
    double halfInterval = 0.0; ///< 95 % half-interval of thresholds and adjustments over participants; for
                               ///< one QUEST+ participant from the posterior; else 0
    std::vector<std::pair<std::string, double>> thresholds{}; ///< staircase, QUEST+: of each participant, in
                                                              ///< dB
};

/// Sorted by kind, condition and stimulus. A staircase threshold is the mean level of the later half of the
/// reversals (Levitt 1971), or the last level if there are fewer than two. A QUEST+ threshold is the
/// posterior mean, recomputed from levels and answers; of several participants with the widths that all tell
/// together (QuestPooled.h). Several sessions of a participant are averaged. Any thread (allocates).
std::vector<LevelSummary> summariseLevels(const std::vector<LevelTrial>& trials);

} // namespace physvib
