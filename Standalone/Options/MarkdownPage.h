// SPDX-License-Identifier: GPL-3.0-or-later
// The page Docs/commands.md, generated from the option table.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// Markdown with a table of options for each command of a program. Message thread.
std::string markdownPage(const OptionTable& program);

} // namespace physvib
