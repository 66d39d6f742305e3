// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib render`, parsed to checked values.
#pragma once
#include "Calls/RenderJob.h"
#include "Options/OptionTable.h"

namespace physvib {
class OptionTable;

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

} // namespace physvib
