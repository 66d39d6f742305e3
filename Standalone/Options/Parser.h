// SPDX-License-Identifier: GPL-3.0-or-later
// From the words of a call to the values of a table: the only file that knows CLI11 is Parser.cpp.
#pragma once
#include "Options/OptionTable.h"
#include <string>

namespace physvib {

/// What became of a call; an empty `fault`: its values are where the table's rows say.
struct ParsedWords {
    std::string fault;   ///< one line
    std::string unknown; ///< the first word that is no option and has no place
    std::string help;    ///< what --help or --version answers: then `fault` is no matter of the caller's

    /// The fault as the program says it.
    std::string reason() const { return unknown.empty() ? fault : "unknown: " + unknown; }
};

/// Of a program's arguments. M only.
ParsedWords parseArguments(OptionTable& table, int argc, char** argv);

/// Of a call in one text, without the program's name: "render drop --law=log". M only.
ParsedWords parseText(OptionTable& table, const std::string& call);

} // namespace physvib
