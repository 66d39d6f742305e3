// SPDX-License-Identifier: MIT
// What a study is going to do, written before its first participant, and what a report says of it afterwards.
#pragma once
#include "Io/Result.h"
#include "Lab/Report/ReportBuilder.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct PlannedStudy {
    std::string text;   ///< design, number of participants, stop rules, exclusions, tests and corrections
    std::string script; ///< analysis.R with these tests; empty if there are none
};

/// The tests are those of a report of simulated participants. Message thread only.
Result<PlannedStudy> plannedStudy(const Protocol& protocol, int participants);

/// Sentences on what differs between a plan and the trials, or that nothing does; the first has the plan's
/// hash. `tests`: those of the report. Fails on a text that is no plan. Any thread (allocates).
Result<std::vector<std::string>> comparedWithPlan(std::string_view plan, std::string_view name,
                                                  const ReportTrials& trials,
                                                  const std::vector<std::string>& tests);

} // namespace physvib
