// SPDX-License-Identifier: MIT
// Windows has no pseudo-terminals that a program could open by name: all lines are ports.
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
