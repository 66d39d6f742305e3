// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib stimulus`: single stimuli of the studies, as files.
#pragma once
#include <string>

namespace CLI {
class App;
}

namespace physvib {

/// As given on the command line.
struct StimulusOptions {
    std::string pattern;           ///< "ABA-250"
    std::string recording;         ///< path of a WAV file
    std::string grid, cell, at;    ///< "5x5", "2,3"; or "0.25,0.5"
    std::string points = "corners";
    std::string layout = "phone4";
    std::string law = "linear";
    double exponent = 1.0;
    double frequencyHz = 205.0, levelG = 1.0, seconds = 1.0, gapSeconds = 0.1;
    int sampleRateHz = 48000;
    int enchanters = 4;            ///< of `stimulus list`
    std::string wavPath, picturePath;
};

/// Declares pattern, phantom, wav and list as subcommands of `command`.
void declareStimulus(CLI::App& command, StimulusOptions& options);

/// Makes what `command` has parsed; the code to leave with.
int runStimulus(const CLI::App& command, const StimulusOptions& options);

} // namespace physvib
