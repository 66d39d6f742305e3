// SPDX-License-Identifier: GPL-3.0-or-later
// The last part of a session as a movie.
#pragma once
#include "Live/Documents/SessionFile.h"
#include <functional>
#include <string>

namespace physvib {

/// Writes an animated WebP of the last `seconds` of the session, which appears whole or not at all: worlds
/// and impacts as they followed each other, and what the enchanters of `layout` played. `progress` gets
/// shares of 0 to 1; false from it cancels. Empty, or one line with the reason; "cancelled". Any thread but
/// R.
std::string writeSessionMovie(const SavedSession& session, const LayoutDescription& layout, double seconds,
                              const std::string& path, const std::function<bool(double)>& progress);

} // namespace physvib
