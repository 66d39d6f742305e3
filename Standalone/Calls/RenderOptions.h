// SPDX-License-Identifier: GPL-3.0-or-later
// The options of `physvib render`, from words to checked values.
#pragma once
#include "Calls/RenderJob.h"

namespace physvib {

class OptionTable;

/// Declares what says which scene is spread how (shared with `play`); `command` fills `options` while it
/// parses.
void declareSceneOptions(OptionTable& command, RenderJob& options);

/// Declares all options of `render`.
void declareRenderOptions(OptionTable& command, RenderJob& options);

/// Notes which options the call had. After parsing.
void noteGiven(const OptionTable& command, RenderJob& options);

} // namespace physvib
