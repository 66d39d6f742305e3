// SPDX-License-Identifier: MIT
// Measured coupling between enchanters, as JSON.
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Coupling.h"
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// The newest version of the format that is read.
constexpr int couplingFormatVersion = 1;

/// The coupling that `text` describes: square matrices of 1 to limits::maxEnchanters rows, magnitudes in
/// shares of a full scale and phases in degrees; or one line `name: measured[0].phase_deg[1][2]: expected
/// ...`. Unknown and repeated fields are errors. Any thread.
Result<MeasuredCoupling> readCoupling(std::string_view text, std::string_view name);

/// The same of a file. M only.
Result<MeasuredCoupling> loadCoupling(const std::filesystem::path& path);

/// `coupling` as JSON; readCoupling gives it back but for the last bits of its phases. Any thread.
std::string couplingJson(const MeasuredCoupling& coupling, const std::string& name,
                         const std::string& source);

} // namespace physvib
