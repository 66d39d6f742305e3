// SPDX-License-Identifier: GPL-3.0-or-later
// A saved session as a WAV file.
#pragma once
#include "Live/Session/SessionRender.h"
#include <string>

namespace physvib {

/// Renders the session to a WAV file that appears whole or not at all. Empty, or one line with the reason;
/// "cancelled". Any thread but R.
std::string renderSessionWav(const SavedSession& session, const SessionExtent& extent,
                             const std::string& path, const std::string& comment);

} // namespace physvib
