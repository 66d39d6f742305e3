// SPDX-License-Identifier: GPL-3.0-or-later
// From the parser's options, or a usage text, to a table.
#include "CommandLine/Reference/CallTable.h"
#include "Files/SceneCatalogue.h"
#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>
#include <sstream>

namespace physvib {
namespace {

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const Scene& scene : builtInScenes()) names.push_back(scene.name);
    return names;
}

/// The parser says them as "TEXT:{on,off}".
std::vector<std::string> choicesIn(const std::string& value) {
    const auto begin = value.find('{'), end = value.rfind('}');
    std::vector<std::string> choices;
    if (begin == std::string::npos || end == std::string::npos) return choices;
    std::istringstream words{value.substr(begin + 1, end - begin - 1)};
    for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
    return choices;
}

std::vector<std::string> spellingsOf(const CLI::Option& option) {
    if (option.get_positional()) return {option.get_name(true, false)};
    std::vector<std::string> spellings;
    for (const std::string& name : option.get_snames()) spellings.push_back("-" + name);
    for (const std::string& name : option.get_lnames()) spellings.push_back("--" + name);
    return spellings;
}

ListedOption listed(const CLI::Option& option) {
    const bool takesNothing = option.get_items_expected_max() == 0;
    const std::string value = takesNothing ? "" : option.get_type_name();
    ListedOption made{spellingsOf(option), value, option.get_default_str(), option.get_description(), choicesIn(value), option.get_positional(),
                      option.get_required()};
    if (made.isPlace && made.spellings.front() == "scene") made.choices = sceneNames();
    return made;
}

} // namespace

ListedCommand listedCommand(const CLI::App& command, const std::string& words) {
    ListedCommand made{words, command.get_description(), {}, {}, {}};
    for (const CLI::Option* option : command.get_options())
        if (!option->get_group().empty()) made.options.push_back(listed(*option));
    for (const CLI::App* inner : command.get_subcommands([](const CLI::App* app) { return !app->get_name().empty(); }))
        made.commands.push_back(listedCommand(*inner, words + ' ' + inner->get_name()));
    return made;
}

ListedCommand listedUsage(const std::string& program, const std::string& meaning, std::string_view usage) {
    ListedCommand made{program, meaning, std::string{usage}, {}, {}};
    const std::regex shown{"(--[a-z][a-z-]*)( [A-Z][A-Z.:]*)?"};
    for (auto found = std::sregex_iterator{made.usage.begin(), made.usage.end(), shown}; found != std::sregex_iterator{}; ++found) {
        const std::string name = found->str(1), value = found->str(2);
        const auto isSame = [&](const ListedOption& option) { return option.spellings.front() == name; };
        if (std::ranges::none_of(made.options, isSame)) made.options.push_back({{name}, value.empty() ? value : value.substr(1), {}, {}, {}, false, false});
    }
    return made;
}

} // namespace physvib
