// SPDX-License-Identifier: GPL-3.0-or-later
// Which words of a call name files that it writes; all others may name files that it reads.
#pragma once
#include <CLI/CLI.hpp>
#include <string>

namespace physvib {

/// ->check(writtenFile) on an option: its value names a file to be written.
inline const CLI::Validator writtenFile{[](std::string&) { return std::string{}; }, "", "written file"};

/// Empty, or that what was parsed names a file to be written that it reads, or one file to be written twice. M.
std::string clashOfCall(CLI::App& app);

} // namespace physvib
