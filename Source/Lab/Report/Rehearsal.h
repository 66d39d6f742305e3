// SPDX-License-Identifier: MIT
// A study with simulated participants, in memory.
#pragma once
#include "Lab/Report/ReportTrials.h"
#include <string>

namespace physvib {

/// The trials of that built-in protocol, of so many participants who answer as `observer` does. Marked as
/// simulated. Any thread (allocates).
ReportTrials rehearse(const std::string& protocol, const std::string& observer, int participants);

} // namespace physvib
