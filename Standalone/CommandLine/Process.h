// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs need of the system before their first word and after their last.
#pragma once
#include <string>

namespace physvib {

/// First of all: the standard descriptors are open, a signal that ends the program takes half-written files along, and a file
/// that may not grow is an error, not a signal. M.
void beginProcess();

/// Last of all: empty if all that was written to standard output arrived, or one line with the reason. M.
std::string outputFault();

} // namespace physvib
