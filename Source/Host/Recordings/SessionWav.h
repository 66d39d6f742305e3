// SPDX-License-Identifier: GPL-3.0-or-later
// Renders a saved session to a WAV file.
#pragma once
#include "Live/Session/SessionRender.h"
#include <string>

namespace physvib {

/// Writes the whole file or none. Returns empty, one line with the reason, or "cancelled". Any thread but R.
std::string renderSessionWav(const SavedSession& session, const SessionExtent& extent,
                             const std::string& path, const std::string& comment);

} // namespace physvib
