// SPDX-License-Identifier: GPL-3.0-or-later
// The page Docs/commands.md, from the table of calls.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// Every command of a program with its options, a table each, as Markdown. M.
std::string markdownPage(const OptionTable& program);

} // namespace physvib
