// SPDX-License-Identifier: GPL-3.0-or-later
// Ends the program, by a signal or after all its output was written.
#include "System/Process.h"
#include "Io/Disk/SystemFile.h"
#include "System/StandardStreams.h"
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <system_error>

namespace physvib {

void endBySignal(int signal) {
    removeAllOnEnd();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

void endAtOnce(int exitCode) {
    std::cout.flush();
    std::fflush(nullptr);
    removeAllOnEnd();
    std::_Exit(exitCode);
}

std::string outputFault() {
    constexpr const char* fault = "standard output: cannot be written";
    errno = 0;
    std::cout.flush();
    if (const auto why = finishOutput()) return why->empty() ? "" : std::string(fault) + ": " + *why;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return {};
    return fault + (errno == 0 ? std::string{} : ": " + std::generic_category().message(errno));
}

} // namespace physvib
