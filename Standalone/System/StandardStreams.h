// SPDX-License-Identifier: GPL-3.0-or-later
// Redirects std::cout and std::cerr to an OutputWriter during playback.
#pragma once
#include "System/Process.h"
#include <cstdint>
#include <optional>
#include <string>

namespace physvib {

/// Redirects std::cout and std::cerr, by complete lines, to an OutputWriter. Text without a newline needs a
/// flush. Message thread.
void sayWithoutWaiting();

/// Number of lines dropped since sayWithoutWaiting(). Any thread but the render thread.
std::uint64_t droppedLines(Standard standard);

/// OutputWriter::finish() of standard output; nullopt if sayWithoutWaiting() was not called. Message thread.
std::optional<std::string> finishOutput();

/// Ends the redirection, after writing the remaining lines of standard error. Message thread.
void endOutput();

} // namespace physvib
