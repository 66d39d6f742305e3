// SPDX-License-Identifier: GPL-3.0-or-later
// std::cout and std::cerr while something plays: through an OutputWriter, whoever says something.
#pragma once
#include "System/Process.h"
#include <cstdint>
#include <optional>
#include <string>

namespace physvib {

/// From now on std::cout and std::cerr go, by whole lines, to an OutputWriter. What has no newline needs a
/// flush. M.
void sayWithoutWaiting();

/// How many lines the one of sayWithoutWaiting has dropped. Any thread but R.
std::uint64_t droppedLines(Standard standard);

/// Its OutputWriter::finish of standard output; nothing if sayWithoutWaiting was not called. M.
std::optional<std::string> finishOutput();

/// The end of sayWithoutWaiting, with what standard error has still to say. M.
void endOutput();

} // namespace physvib
