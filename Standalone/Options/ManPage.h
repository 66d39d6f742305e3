// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages, from the table of calls.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// Its page in man's own language: its options, and those of the commands within it. `pages` are named at the
/// end. M.
std::string manPage(const OptionTable& command, const std::vector<std::string>& pages);

/// "physvib render" as "physvib-render", which is its page's name. M.
std::string pageName(const OptionTable& command);

} // namespace physvib
