// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the reference of a program for installation: manual pages and completions for bash, zsh and fish.
#pragma once
#include "Options/OptionTable.h"
#include <filesystem>
#include <string>

namespace physvib {
/// Option that requests the reference, followed by a folder. Undocumented: only the build uses it.
inline constexpr const char* referenceWord = "--reference";

/// Writes man1/, md/ (Docs/commands.md), bash/, zsh/ and fish/ into the folder. Empty, or one error line. M.
std::string writeReference(const OptionTable& program, const std::filesystem::path& folder);

// Manual pages, generated from the option table.

/// A manual page in roff, with the options of the command and its subcommands. `pages` are listed at the end.
/// Message thread.
std::string manPage(const OptionTable& command, const std::vector<std::string>& pages);

/// "physvib render" as "physvib-render", the name of its page. Message thread.
std::string pageName(const OptionTable& command);

// Shell completion scripts, generated from the option table.

/// A script for that shell, to be installed under the program's name. Values without a list complete to
/// files. Message thread.
std::string bashCompletion(const OptionTable& program);
std::string zshCompletion(const OptionTable& program);
std::string fishCompletion(const OptionTable& program);

} // namespace physvib
