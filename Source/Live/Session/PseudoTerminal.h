// SPDX-License-Identifier: MIT
// Pseudo-terminal as a serial line, for simulated boards; libserialport does not open these. Not available on
// Windows.
#pragma once
#include "Live/Session/SerialLine.h"

namespace physvib {

/// Resolves symbolic links. Any thread but the render thread (R).
bool isPseudoTerminal(const std::string& path);

/// See openSerialLine().
std::unique_ptr<SerialLine> openPseudoTerminal(const std::string& path, std::string& error);

} // namespace physvib
