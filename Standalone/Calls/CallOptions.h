// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib render` and `physvib stimulus`, parsed to checked values; and the files that a call
// names, with checks of calls that come from untrusted files.
#pragma once
#include "Calls/RenderJob.h"
#include "Io/Result.h"
#include "Lab/Study/Stimulus.h"
#include "Options/OptionTable.h"
#include <string>
#include <string_view>

namespace physvib {

/// Declares the options on scene and rendering, which `play` shares. Parsing `command` then fills `options`.
void declareSceneOptions(OptionTable& command, RenderJob& options);

/// Declares all options of `render`.
void declareRenderOptions(OptionTable& command, RenderJob& options);

/// Records which options the call had. To be called after parsing.
void noteGiven(const OptionTable& command, RenderJob& options);

// Options whose values need their own parser, i.e. are not a number, name or path.

/// --law, from the table of panning laws. Message thread, as all here.
Option& addLaw(OptionTable& command, PanningLaw& law);

/// --sound MATERIAL=FILE.wav or HZ=FILE.wav, which may be repeated; `says` is its meaning.
Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string says);

/// --field W,H, --set NAME=VALUE and --method.
Option& addField(OptionTable& command, FieldSize& field);
Option& addSettings(OptionTable& command, SceneSettings& settings);
Option& addMethod(OptionTable& command, RenderJob& job);

/// Arguments of `stimulus`: parsed values where possible, else text. Rows of studies use the same
/// option names (stimulusWords).
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

/// Empty, or an error if the parsed call would write a file that it reads, or one file twice. Message thread.
std::string clashOfCall(const OptionTable& app);

/// Empty, or an error if a call "render ..." or "stimulus ..." in a file names an output file, i.e. has an
/// option marked Option::written anywhere. Message thread.
std::string writtenWordFault(std::string_view call);

/// Empty, or an error if the parsed call of a file reads through a link that leads out of the file's folder
/// (see linkFault). Message thread.
std::string linkOfCallFault(const OptionTable& app, const std::string& folder);

} // namespace physvib
