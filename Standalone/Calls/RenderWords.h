// SPDX-License-Identifier: GPL-3.0-or-later
// From words of a call to values of a job, where a word is no number, name or path.
#pragma once
#include "Calls/RenderJob.h"
#include "Options/OptionTable.h"

namespace physvib {

/// --law, by the table of laws. M only, as all here.
Option& addLaw(OptionTable& command, PanningLaw& law);

/// --sound MATERIAL=FILE.wav or HZ=FILE.wav, which may be repeated; `says` is its meaning.
Option& addSounds(OptionTable& command, RecordedSounds& sounds, std::string says);

/// --field W,H, --set NAME=VALUE and --method.
Option& addField(OptionTable& command, FieldSize& field);
Option& addSettings(OptionTable& command, SceneSettings& settings);
Option& addMethod(OptionTable& command, RenderJob& job);

} // namespace physvib
