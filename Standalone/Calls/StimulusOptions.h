// SPDX-License-Identifier: GPL-3.0-or-later
// The words of `physvib stimulus`, and the value that they say: the words with which rows of studies say it
// (stimulusWords).
#pragma once
#include "Io/Result.h"
#include "Lab/Study/StimulusJob.h"
#include <string>

namespace physvib {

class OptionTable;

/// As given on the command line: values where a word is one, and text.
struct StimulusOptions {
    PatternJob pattern;
    PhantomJob phantom;
    StimulusJob job;            ///< what both have
    std::string grid, cell, at; ///< "5x5", "2,3"; or "0.25,0.5"
    std::string points = "corners", frequency = "205";
    int sampleRateHz = 48000;
    int enchanters = 4; ///< of `stimulus list`
    std::string wavPath, picturePath;
};

/// Declares pattern, phantom, wav and list as subcommands of `command`.
void declareStimulus(OptionTable& command, StimulusOptions& options);

/// What `command` has parsed (not list), without a fault; or what is wrong with its words. M only.
Result<StimulusJob> readStimulus(const OptionTable& command, const StimulusOptions& options);

} // namespace physvib
