// SPDX-License-Identifier: MIT
// QUEST+ as a session asks for it, and as the words that stand in every row of it.
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
    double leastDb = 0.0, mostDb = 20.0, stepDb = 0.5; ///< levels that can be presented, and thresholds that
                                                       ///< are thought possible
    double leastWidthDb = 2.0, mostWidthDb = 20.0;     ///< of the function, thought possible
    double lapse = 0.02;
    int trials = 40;
    double deviationDb = 0.0; ///< it ends earlier once the threshold is known that well; 0: it does not
    bool operator==(const QuestMethod&) const = default;
};

/// What makes no sense as a whole, `.step_db: expected ...`; empty if all does. Any thread (allocates).
std::string questFault(const QuestMethod& method);

/// What is thought possible before the first trial. Any thread (allocates).
QuestPlan questPlan(const QuestMethod& method, double guess);

/// All that the plan is made of, `weibull guess 0.5 lapse 0.02 levels_db 0 0.5 20 widths_db 2 20`. Any thread
/// (allocates).
std::string questWords(const QuestMethod& method, double guess);

/// The plan of such words; none if they are not. Any thread (allocates).
std::optional<QuestPlan> questPlan(std::string_view words);

} // namespace physvib
