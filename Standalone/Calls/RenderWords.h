// SPDX-License-Identifier: GPL-3.0-or-later
// Options whose values need their own parser, i.e. are not a number, name or path.
#pragma once
#include "Calls/RenderJob.h"
#include "Options/OptionTable.h"

namespace physvib {

/// --law, from the table of panning laws. Message thread only, as all here.
Option& addLaw(OptionTable& command, PanningLaw& law);

/// --sound MATERIAL=FILE.wav or HZ=FILE.wav, which may be repeated; `says` is its meaning.
Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string says);

/// --field W,H, --set NAME=VALUE and --method.
Option& addField(OptionTable& command, FieldSize& field);
Option& addSettings(OptionTable& command, SceneSettings& settings);
Option& addMethod(OptionTable& command, RenderJob& job);

} // namespace physvib
