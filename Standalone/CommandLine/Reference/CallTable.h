// SPDX-License-Identifier: GPL-3.0-or-later
// What a program can be told, as data: manual pages and completions are written from it, and it is read from the parser's own options.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace physvib {

struct ListedOption {
    std::vector<std::string> spellings; ///< "-h", "--help"; of a word that has only a place: its name
    std::string value;                  ///< what follows it: "FLOAT:0 to 1"; empty: nothing does
    std::string initial;                ///< what it is if nobody says it
    std::string meaning;
    std::vector<std::string> choices; ///< all that it may be, or some that are built in
    bool isPlace = false, isRequired = false;
};

struct ListedCommand {
    std::string words; ///< "physvib analyse anova"
    std::string meaning;
    std::string usage; ///< lines of a program that says them itself; else they are made from the options
    std::vector<ListedOption> options;
    std::vector<ListedCommand> commands;
};

/// All that the parser takes, below `words`. M.
ListedCommand listedCommand(const CLI::App& command, const std::string& words);

/// Of a program that has words instead of a parser: its options are those that its usage shows. M.
ListedCommand listedUsage(const std::string& program, const std::string& meaning, std::string_view usage);

} // namespace physvib
