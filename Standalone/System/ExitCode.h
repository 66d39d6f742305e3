// SPDX-License-Identifier: GPL-3.0-or-later
// What the command line's exit codes mean, and how it says what went wrong.
#pragma once
#include "Io/Text/CleanText.h"
#include <iostream>
#include <string_view>

namespace physvib {

enum ExitCode : int {
    exitDone = 0,
    exitFailed = 1, ///< a file, a device, a render: one line on stderr says why
    exitUsage = 2   ///< the call's words are off
};

/// One line on stderr, whatever names are in it.
inline void tell(std::string_view words) { std::cerr << "physvib: " + cleanLine(words) + '\n'; }

/// The same; the code to leave with.
inline int leave(ExitCode code, std::string_view reason) {
    tell(reason);
    return code;
}

} // namespace physvib
