// SPDX-License-Identifier: MIT
// Where a simulated board speaks: a pseudo-terminal, which libserialport does not open. Windows has none.
#pragma once
#include "Live/Session/SerialLine.h"

namespace physvib {

/// Also by another name, as links give one that stays. Any thread but R.
bool isPseudoTerminal(const std::string& path);

/// As openSerialLine().
std::unique_ptr<SerialLine> openPseudoTerminal(const std::string& path, std::string& error);

} // namespace physvib
