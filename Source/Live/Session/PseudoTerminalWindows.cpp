// SPDX-License-Identifier: MIT
// On Windows, which has no pseudo-terminals that a program can open by name: all lines are serial ports.
#if defined(_WIN32)
#include "Live/Session/PseudoTerminal.h"

namespace physvib {

bool isPseudoTerminal(const std::string&) { return false; }

std::unique_ptr<SerialLine> openPseudoTerminal(const std::string& path, std::string& error) {
    error = path + ": expected a serial port";
    return nullptr;
}

} // namespace physvib
#endif
