// SPDX-License-Identifier: GPL-3.0-or-later
// Exit codes of the command line, and error messages on stderr.
#pragma once
#include "Io/Text/CleanText.h"
#include <iostream>
#include <string_view>

namespace physvib {

enum ExitCode : int {
    exitDone = 0,
    exitFailed = 1, ///< a file, device or render failed; one line on stderr says why
    exitUsage = 2   ///< the arguments are invalid
};

/// Prints one line on stderr, with unprintable characters replaced.
inline void tell(std::string_view words) { std::cerr << "physvib: " + cleanLine(words) + '\n'; }

/// Prints the line and returns the exit code.
inline int leave(ExitCode code, std::string_view reason) {
    tell(reason);
    return code;
}

} // namespace physvib
