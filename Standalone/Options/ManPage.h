// SPDX-License-Identifier: GPL-3.0-or-later
// Manual pages, generated from the option table.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// A manual page in roff, with the options of the command and its subcommands. `pages` are listed at the end.
/// Message thread.
std::string manPage(const OptionTable& command, const std::vector<std::string>& pages);

/// "physvib render" as "physvib-render", the name of its page. Message thread.
std::string pageName(const OptionTable& command);

} // namespace physvib
