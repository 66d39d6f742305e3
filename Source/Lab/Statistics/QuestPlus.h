// SPDX-License-Identifier: MIT
// Adaptive method QUEST+ (Watson 2017): presents each trial at the level with the largest expected
// information about the psychometric function.
#pragma once
#include "Lab/Statistics/Psychometric.h"
#include <vector>

namespace physvib {

/// Grid of the uniform prior.
struct QuestPlan {
    PsychometricShape shape = PsychometricShape::weibull;
    double guess = 0.5;
    std::vector<double> levels;             ///< levels that can be presented
    std::vector<double> thresholds, widths; ///< of the psychometric functions in the grid
    std::vector<double> lapses{0.02};
};

/// QUEST+ run for one threshold of one observer. One thread at a time (allocates when constructed).
class QuestPlus {
public:
    /// Precondition: every list of `plan` has at least one entry.
    explicit QuestPlus(QuestPlan plan);

    double level() const noexcept { return plan_.levels[next_]; } ///< level of the next trial
    void answer(bool isCorrect) { answerAt(level(), isCorrect); } ///< answer to a trial at `level()`
    void answerAt(double level, bool isCorrect); ///< answer to a trial at any level; uses the nearest level
                                                 ///< of the plan
    PsychometricFunction estimate() const;       ///< posterior mean
    double thresholdDeviation() const;           ///< posterior standard deviation of the threshold
    double thresholdHalfInterval(double share) const; ///< half-width of the interval around the mean
                                                      ///< threshold that has this posterior probability
    int trials() const noexcept { return trials_; }

private:
    PsychometricFunction possible(std::size_t index) const;
    std::vector<double> thresholdBelief() const;
    double correct(std::size_t level, std::size_t index) const {
        return correct_[level * belief_.size() + index];
    }
    void chooseNext();

    QuestPlan plan_;
    std::vector<double> belief_;  ///< posterior probability of each function of the grid; sums to 1
    std::vector<double> correct_; ///< probability of a correct answer, by level and function
    std::vector<double> unsure_;  ///< entropy of that answer
    std::size_t next_ = 0;
    int trials_ = 0;
};

} // namespace physvib
