// SPDX-License-Identifier: GPL-3.0-or-later
// Parses command-line arguments into the values of an option table. Only Parser.cpp uses CLI11.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// Result of parsing; if `fault` is empty, the targets of the table are set.
struct ParsedWords {
    std::string fault;   ///< error in one line
    std::string unknown; ///< the first unknown argument
    std::string help;    ///< output of --help or --version; if set, `fault` is not an error

    /// The error as printed.
    std::string reason() const { return unknown.empty() ? fault : "unknown: " + unknown; }
};

/// Parses a program's arguments. Message thread.
ParsedWords parseArguments(OptionTable& table, int argc, char** argv);

/// Parses a call given as text without the program's name: "render drop --law=log". Message thread.
ParsedWords parseText(OptionTable& table, const std::string& call);

} // namespace physvib
