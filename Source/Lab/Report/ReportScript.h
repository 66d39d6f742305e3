// SPDX-License-Identifier: MIT
// Creates report.R, which repeats the report's tests in R from the tables of the report.
#pragma once
#include "Lab/Report/ReportBuilder.h"
#include <string>

namespace physvib {

/// Run in the report's folder, the script prints each p beside R's and fails if one differs by more than a
/// millionth. Any thread (allocates).
std::string reportScript(const ReportBuilder& report);

} // namespace physvib
