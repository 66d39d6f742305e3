// SPDX-License-Identifier: MIT
// Sessions of the protocol that a participant's rows do not bring to their end.
#pragma once
#include "Lab/Report/ReportTrials.h"
#include <string>
#include <vector>

namespace physvib {

/// A session in a condition that ended before the protocol ends it.
struct UnfinishedRun {
    std::string participant, condition, session;
    std::size_t trials = 0;  ///< rows of it
    std::size_t planned = 0; ///< of the protocol; of a staircase or a precision: the most
    bool isAdaptive = false; ///< its threshold rests on too few trials

    std::string words() const;
};

/// From the columns participant, condition, session and correct, and the protocol; excluded participants are
/// not among them. Nothing is known without a protocol. Explorations end when participants like. Any thread
/// (allocates).
std::vector<UnfinishedRun> unfinishedRuns(const ReportTrials& trials);

} // namespace physvib
