// SPDX-License-Identifier: GPL-3.0-or-later
// The reference of a program: manual pages, and completions for bash, zsh and fish, as files of a folder that
// an installation copies.
#pragma once
#include "Options/OptionTable.h"
#include <filesystem>
#include <string>

namespace physvib {

/// The word that asks a program for it, before a folder; it is told nowhere else, since a build says it, not
/// a person.
inline constexpr const char* referenceWord = "--reference";

/// Writes man1/, md/ (Docs/commands.md), bash/, zsh/ and fish/ into the folder. Empty, or one line with the
/// reason. M.
std::string writeReference(const OptionTable& program, const std::filesystem::path& folder);

} // namespace physvib
