// SPDX-License-Identifier: MIT
// QUEST+ (Watson 2017): each trial is at the level from which most is to be learnt about the psychometric
// function.
#pragma once
#include "Lab/Statistics/Psychometric.h"
#include <vector>

namespace physvib {

/// What is thought possible before the first trial, all alike likely.
struct QuestPlan {
    PsychometricShape shape = PsychometricShape::weibull;
    double guess = 0.5;
    std::vector<double> levels;             ///< that can be presented
    std::vector<double> thresholds, widths; ///< of the function
    std::vector<double> lapses{0.02};
};

/// One observer's trials of one threshold. One thread at a time (allocates when made).
class QuestPlus {
public:
    /// Every list of `plan` has at least one entry.
    explicit QuestPlus(QuestPlan plan);

    double level() const noexcept { return plan_.levels[next_]; } ///< of the next trial
    void answer(bool isCorrect) { answerAt(level(), isCorrect); } ///< to a trial at `level`
    void answerAt(double level, bool isCorrect); ///< to a trial at the nearest of the plan's levels, whoever
                                                 ///< chose it
    PsychometricFunction estimate() const;       ///< mean over what is still possible
    double thresholdDeviation() const;           ///< its standard deviation
    double thresholdHalfInterval(double share) const; ///< about its mean, that holds this share of the belief
    int trials() const noexcept { return trials_; }

private:
    PsychometricFunction possible(std::size_t index) const;
    std::vector<double> thresholdBelief() const;
    double correct(std::size_t level, std::size_t index) const {
        return correct_[level * belief_.size() + index];
    }
    void chooseNext();

    QuestPlan plan_;
    std::vector<double> belief_;  ///< in each possible function; sums to 1
    std::vector<double> correct_; ///< probability at each level under each function
    std::vector<double> unsure_;  ///< entropy of an answer there
    std::size_t next_ = 0;
    int trials_ = 0;
};

} // namespace physvib
