// SPDX-License-Identifier: GPL-3.0-or-later
// Descriptors 0 to 2, signals, and the fate of standard output.
#include "CommandLine/Process.h"
#include "Files/Disk/SystemFile.h"
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fcntl.h>
#include <initializer_list>
#include <iostream>
#include <system_error>
#include <unistd.h>

namespace physvib {
namespace {

// A file that is opened while one of them is closed gets its number, and is taken for it. Opened the wrong way round, reading
// standard input and writing the others stay the errors that they are.
void openStandardDescriptors() {
    for (int standard = STDIN_FILENO; standard <= STDERR_FILENO; ++standard)
        if (fcntl(standard, F_GETFD) < 0 && open("/dev/null", standard == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0) std::_Exit(1);
}

void end(int signal) {
    removeAllOnEnd();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

} // namespace

void beginProcess() {
    openStandardDescriptors();
    std::signal(SIGXFSZ, SIG_IGN);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (std::signal(signal, end) == SIG_IGN) std::signal(signal, SIG_IGN); // as nohup wants it
}

std::string outputFault() {
    errno = 0;
    std::cout.flush();
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.good()) return {};
    return "standard output: cannot be written" + (errno == 0 ? std::string{} : ": " + std::generic_category().message(errno));
}

} // namespace physvib
