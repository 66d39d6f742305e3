// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the reference of a program for installation: manual pages and completions for bash, zsh and fish.
#pragma once
#include "Options/OptionTable.h"
#include <filesystem>
#include <string>

namespace physvib {

/// Option that requests the reference, followed by a folder. It is undocumented, because only the build uses
/// it.
inline constexpr const char* referenceWord = "--reference";

/// Writes man1/, md/ (Docs/commands.md), bash/, zsh/ and fish/ into the folder. Empty, or one error line.
/// Message thread.
std::string writeReference(const OptionTable& program, const std::filesystem::path& folder);

} // namespace physvib
