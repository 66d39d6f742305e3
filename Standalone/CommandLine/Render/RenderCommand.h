// SPDX-License-Identifier: GPL-3.0-or-later
// `physvib render`: a scene or an event list to WAV, CSV and PNG, faster than real time.
#pragma once
#include "Calls/RenderOptions.h"

namespace physvib {

/// Does what the (checked) options say. All files appear, or none: exitDone, or exitFailed with a line on
/// stderr.
int runRender(const RenderJob& options);

} // namespace physvib
