// SPDX-License-Identifier: MIT
// CSV files of stimulus levels that experts adjusted, used by another study.
#pragma once
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Study/StimulusLevels.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Parses the columns condition, stimulus, alternative, level_db; otherwise one line that names file, line
/// and column. Any thread.
Result<std::vector<StimulusLevel>> readStimulusLevels(std::string_view text, std::string_view name);

/// `levels` as CSV, with number of participants and standard deviation. Any thread.
std::string stimulusLevelsCsv(const std::vector<StimulusLevel>& levels, const Provenance& provenance);

} // namespace physvib
