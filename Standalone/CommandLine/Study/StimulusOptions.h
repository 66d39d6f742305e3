// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib stimulus`, and the stimulus that they say.
#pragma once
#include "Session/StimulusRender.h"
#include <string>

namespace physvib {

class OptionTable;

/// As given on the command line.
struct StimulusOptions {
    std::string pattern;           ///< "ABA-250"
    std::string recording;         ///< path of a WAV file
    std::string grid, cell, at;    ///< "5x5", "2,3"; or "0.25,0.5"
    std::string points = "corners";
    std::string layout = "phone4";
    std::string law = "linear";
    double exponent = 1.0;
    std::string frequency = "205"; ///< Hz, or "resonance": that of the layout's actuators
    double levelG = 1.0, seconds = 1.0, gapSeconds = 0.1;
    int sampleRateHz = 48000;
    int enchanters = 4;            ///< of `stimulus list`
    std::string wavPath, picturePath;
};

/// A stimulus on its way to a file or a hand; `usage` says what is wrong with the call, `error` with a file or a level.
struct MadeStimulus {
    std::string usage, error, title;
    std::string note; ///< on what was taken away from a recording; mostly empty
    Stimulus stimulus; ///< empty events: a recording
    StimulusSound sound;
};

/// Declares pattern, phantom, wav and list as subcommands of `command`.
void declareStimulus(OptionTable& command, StimulusOptions& options);

/// What `command` has parsed (not list), on that layout; recordings as samples, all else as events. M only.
MadeStimulus makeStimulus(const OptionTable& command, const StimulusOptions& options, const LayoutDescription& layout);

} // namespace physvib
