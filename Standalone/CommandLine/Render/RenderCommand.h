// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib render`: a scene or an event list to WAV, CSV and PNG, faster than real time.
#pragma once
#include "Calls/RenderOptions.h"
#include "CommandLine/Render/RenderListener.h"

namespace physvib {

/// Does what the (checked) options say. All files appear, or none: exitDone, or exitFailed with a line on
/// stderr. A listener hears the render instead of a person: warnings apart, nothing is told of one that is
/// well.
int runRender(const RenderJob& options, RenderListener* listener = nullptr);

} // namespace physvib
