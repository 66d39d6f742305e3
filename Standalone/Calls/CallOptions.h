// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib render` and `physvib stimulus`, parsed to checked values; and checks of the files
// that a call names, also of calls in untrusted files. All for the message thread.
#pragma once
#include "Calls/RenderJob.h"
#include "Io/Result.h"
#include "Lab/Study/StimulusJob.h"
#include "Options/OptionTable.h"
#include <string>
#include <string_view>

namespace physvib {

/// Declares the options on scene and rendering, which `play` shares. Parsing `command` then fills `options`.
void declareSceneOptions(OptionTable& command, RenderJob& options);

/// Declares all options of `render`.
void declareRenderOptions(OptionTable& command, RenderJob& options);

/// Records which options the call had. To be called after parsing.
void recordGivenOptions(const OptionTable& command, RenderJob& options);

/// Adds --law, a name from the table of panning laws.
Option& addLaw(OptionTable& command, PanningLaw& law);

/// Adds --sound MATERIAL=FILE.wav or HZ=FILE.wav, which may be repeated; `helpText` is its help text.
Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string helpText);

/// These add --field W,H, --set NAME=VALUE and --method.
Option& addField(OptionTable& command, FieldSize& field);
Option& addSettings(OptionTable& command, SceneSettings& settings);
Option& addMethod(OptionTable& command, RenderJob& job);

/// Arguments of `stimulus`: parsed values where possible, else text. Rows of studies use the same
/// option names (stimulusOptions).
struct StimulusOptions {
    PatternJob pattern;
    PhantomJob phantom;
    StimulusJob job;               ///< fields common to both kinds
    std::string grid, cell, place; ///< "5x5", "2,3"; or "0.25,0.5"
    std::string points = "corners", frequency = "205", levelMeasure = "peak";
    int sampleRateHz = 48000;
    int enchanters = 4; ///< for `stimulus list`
    std::string wavPath, picturePath;
};

/// Declares pattern, phantom, wav and list as subcommands of `command`.
void declareStimulus(OptionTable& command, StimulusOptions& options);

/// The job of the parsed `command` (not list), or an error in its arguments.
Result<StimulusJob> readStimulus(const OptionTable& command, const StimulusOptions& options);

/// Empty, or an error if the parsed call would write a file that it reads, or one file twice.
std::string callFileClash(const OptionTable& app);

/// Empty, or an error if a call "render ..." or "stimulus ..." in a file names an output file, i.e. has an
/// option marked Option::outputFile anywhere.
std::string outputOptionError(std::string_view call);

/// Empty, or an error if the parsed call of a file reads through a link that leads out of the file's folder
/// (see linkError).
std::string callLinkError(const OptionTable& app, const std::string& folder);

} // namespace physvib
