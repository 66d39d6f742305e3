// SPDX-License-Identifier: MIT
// Adaptive method QUEST+ (Watson 2017): presents each trial at the level with the largest expected
// information about the psychometric function. The file holds the run of one observer, the thresholds of
// several runs together, and the settings of a session with their text in each row of the trial file.
#pragma once
#include "Lab/Study/Psychometric.h"
#include <optional>
#include <span>
#include <string>
#include <string_view>
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
    void answerAt(double level, bool isCorrect); ///< `level` is rounded to the nearest of the plan
    PsychometricFunction estimate() const;       ///< posterior mean
    double thresholdDeviation() const;           ///< posterior standard deviation of the threshold
    int trials() const noexcept { return trials_; }

private:
    PsychometricFunction gridFunction(std::size_t index) const;
    double correct(std::size_t level, std::size_t index) const {
        return correct_[level * posterior_.size() + index];
    }
    void chooseNext();

    QuestPlan plan_;
    std::vector<double> posterior_;       ///< posterior probability of each function of the grid; sums to 1
    std::vector<double> correct_;         ///< probability of a correct answer, by level and function
    std::vector<double> answerEntropies_; ///< entropy of that answer
    std::size_t next_ = 0;
    int trials_ = 0;
};

// Thresholds of several observers' QUEST+ runs: all runs together estimate the width of the psychometric
// function, which replaces the uniform prior of each run.

struct PooledThresholds {
    std::vector<double> thresholds; ///< posterior mean of each run
    double deviation = 0.0; ///< posterior standard deviation of their mean that is due to the widths: an
                            ///< error of all runs alike, which does not show in their spread
};

/// `runs`: the answers of each run by level, in any order; all runs have the same plan. Precondition: every
/// list of `plan` and `runs` has at least one entry. Any thread (allocates).
PooledThresholds pooledThresholds(const QuestPlan& plan, std::span<const std::vector<LevelCount>> runs);

/// QUEST+ (Watson 2017) on this alternative's level: choosing it is correct.
struct QuestMethod {
    std::string alternative;
    PsychometricShape shape = PsychometricShape::weibull;
    double minDb = 0.0, maxDb = 20.0, stepDb = 0.5; ///< levels to present, also the prior's thresholds
    double minWidthDb = 2.0, maxWidthDb = 20.0;     ///< widths of the psychometric function in the prior
    double lapse = 0.02;
    int trials = 40;
    double deviationDb = 0.0; ///< target standard deviation of the threshold, at which it ends early; 0: none
    bool operator==(const QuestMethod&) const = default;
};

/// Empty, or the first inconsistency, e.g. `.step_db: expected ...`. Any thread (allocates).
std::string questError(const QuestMethod& method);

/// The prior before the first trial. Any thread (allocates).
QuestPlan questPlan(const QuestMethod& method, double guess);

/// All settings of the plan as text, `weibull guess 0.5 lapse 0.02 levels_db 0 0.5 20 widths_db 2 20`. Any
/// thread (allocates).
std::string questText(const QuestMethod& method, double guess);

/// Parses the text of questText(); nullopt if it is invalid. Any thread (allocates).
std::optional<QuestPlan> questPlan(std::string_view words);

} // namespace physvib
