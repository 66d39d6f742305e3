// SPDX-License-Identifier: GPL-3.0-or-later
// Shell completion scripts, generated from the option table.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// A script for that shell, to be installed under the program's name. Values without a list complete to
/// files. Message thread.
std::string bashCompletion(const OptionTable& program);
std::string zshCompletion(const OptionTable& program);
std::string fishCompletion(const OptionTable& program);

} // namespace physvib
