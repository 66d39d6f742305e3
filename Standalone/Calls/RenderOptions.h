// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib render`, parsed to checked values.
#pragma once
#include "Calls/RenderJob.h"

namespace physvib {

class OptionTable;

/// Declares the options on scene and rendering, which `play` shares. Parsing `command` then fills `options`.
void declareSceneOptions(OptionTable& command, RenderJob& options);

/// Declares all options of `render`.
void declareRenderOptions(OptionTable& command, RenderJob& options);

/// Records which options the call had. To be called after parsing.
void noteGiven(const OptionTable& command, RenderJob& options);

} // namespace physvib
