// SPDX-License-Identifier: MIT
// Levels of stimuli as CSV: what experts set, for the study that uses it.
#pragma once
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Study/StimulusLevels.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The levels that `text` holds: columns condition, stimulus, alternative, level_db; or one line that names
/// file, line and column. Any thread.
Result<std::vector<StimulusLevel>> readStimulusLevels(std::string_view text, std::string_view name);

/// `levels` as CSV, with participants and their standard deviation. Any thread.
std::string stimulusLevelsCsv(const std::vector<StimulusLevel>& levels, const Provenance& provenance);

} // namespace physvib
