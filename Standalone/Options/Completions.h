// SPDX-License-Identifier: GPL-3.0-or-later
// What a shell proposes while a call is typed, from the table of calls.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// A script for that shell, which is put where the shell looks for the program's name. Where nothing is
/// listed, files are proposed. M.
std::string bashCompletion(const OptionTable& program);
std::string zshCompletion(const OptionTable& program);
std::string fishCompletion(const OptionTable& program);

} // namespace physvib
