// SPDX-License-Identifier: MIT
// report.R: a report's tests again, by R itself, from the tables beside it.
#pragma once
#include "Lab/Report/ReportBuilder.h"
#include <string>

namespace physvib {

/// Run in the report's folder, it prints each p beside R's and fails if one differs by more than a millionth.
/// Any thread (allocates).
std::string reportScript(const ReportBuilder& report);

} // namespace physvib
