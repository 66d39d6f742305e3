// SPDX-License-Identifier: MIT
// JSON files of the measured coupling between actuators.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Coupling.h"
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// Newest readable version of the format.
constexpr int couplingFormatVersion = 1;

/// Parses square matrices of 1 to limits::maxEnchanters rows, with magnitudes in full scales and phases in
/// degrees. Otherwise one line `name: measured[0].phase_deg[1][2]: expected ...`. Unknown and repeated fields
/// are errors. Any thread.
Result<MeasuredCoupling> readCoupling(std::string_view text, std::string_view name);

/// Reads a file with readCoupling(). Message thread only.
Result<MeasuredCoupling> loadCoupling(const std::filesystem::path& path);

/// `coupling` as JSON; readCoupling() restores it except for the last bits of its phases. Any thread.
std::string couplingJson(const MeasuredCoupling& coupling, const std::string& name,
                         const std::string& source);

} // namespace physvib
