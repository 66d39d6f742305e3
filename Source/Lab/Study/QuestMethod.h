// SPDX-License-Identifier: MIT
// Settings of the adaptive method QUEST+ in a session, and their text in each row of the trial file.
#pragma once
#include "Lab/Statistics/QuestPlus.h"
#include <optional>
#include <string>
#include <string_view>

namespace physvib {

/// QUEST+ (Watson 2017) on this alternative's level: choosing it is correct.
struct QuestMethod {
    std::string alternative;
    PsychometricShape shape = PsychometricShape::weibull;
    double leastDb = 0.0, mostDb = 20.0, stepDb = 0.5; ///< levels that can be presented; also the prior's
                                                       ///< thresholds
    double leastWidthDb = 2.0, mostWidthDb = 20.0;     ///< widths of the psychometric function in the prior
    double lapse = 0.02;
    int trials = 40;
    double deviationDb = 0.0; ///< target standard deviation of the threshold, at which it ends early; 0: none
    bool operator==(const QuestMethod&) const = default;
};

/// Empty, or the first inconsistency, e.g. `.step_db: expected ...`. Any thread (allocates).
std::string questFault(const QuestMethod& method);

/// The prior before the first trial. Any thread (allocates).
QuestPlan questPlan(const QuestMethod& method, double guess);

/// All settings of the plan as text, `weibull guess 0.5 lapse 0.02 levels_db 0 0.5 20 widths_db 2 20`. Any
/// thread (allocates).
std::string questWords(const QuestMethod& method, double guess);

/// Parses the text of questWords(); nullopt if it is invalid. Any thread (allocates).
std::optional<QuestPlan> questPlan(std::string_view words);

} // namespace physvib
