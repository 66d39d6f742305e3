// SPDX-License-Identifier: GPL-3.0-or-later
// Options of `physvib stimulus`, and the stimulus job that they specify. Rows of studies use the same option
// names (stimulusWords).
#pragma once
#include "Io/Result.h"
#include "Lab/Study/Stimulus.h"
#include <string>

namespace physvib {

class OptionTable;

/// Command-line arguments: parsed values where possible, else text.
struct StimulusOptions {
    PatternJob pattern;
    PhantomJob phantom;
    StimulusJob job;            ///< fields common to both kinds
    std::string grid, cell, at; ///< "5x5", "2,3"; or "0.25,0.5"
    std::string points = "corners", frequency = "205", levelOf = "peak";
    int sampleRateHz = 48000;
    int enchanters = 4; ///< for `stimulus list`
    std::string wavPath, picturePath;
};

/// Declares pattern, phantom, wav and list as subcommands of `command`.
void declareStimulus(OptionTable& command, StimulusOptions& options);

/// The job of the parsed `command` (not list), or an error in its arguments. Message thread.
Result<StimulusJob> readStimulus(const OptionTable& command, const StimulusOptions& options);

} // namespace physvib
