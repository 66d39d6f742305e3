// SPDX-License-Identifier: GPL-3.0-or-later
// Creates option entries with defaults from the type of their target, or from a usage text.
#include "Options/OptionTable.h"
#include "Io/Text/NameList.h"
#include "Scene/SceneFile.h"
#include <algorithm>
#include <regex>
#include <type_traits>

namespace physvib {
namespace {

template <class T>
std::string typeOf(const T*) {
    if constexpr (std::is_same_v<T, bool>)
        return {};
    else if constexpr (std::is_floating_point_v<T>)
        return "FLOAT";
    else if constexpr (std::is_integral_v<T>)
        return std::is_signed_v<T> ? "INT" : "UINT";
    else
        return "TEXT";
}

template <class T>
std::string initialOf(const T* target) {
    if constexpr (std::is_same_v<T, std::string>) return *target;
    if constexpr (!std::is_arithmetic_v<T> || std::is_same_v<T, bool>)
        return {};
    else
        return (std::ostringstream{} << *target).str();
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> words;
    std::istringstream stream{text};
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

std::string braced(const std::vector<std::string>& words) { return '{' + joined(words, ",") + '}'; }

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embeddedScenes()) // parsing them takes longer than many a call
        names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    return names;
}

} // namespace

Option& Option::oneOf(std::vector<std::string> words) {
    range = braced(words);
    choices = std::move(words);
    check = Check::choice;
    return *this;
}

Option& Option::numbered(std::vector<std::pair<std::string, int>> words) {
    std::ranges::sort(words);
    std::vector<std::string> shown, bare;
    for (const auto& [word, number] : words) {
        choices.push_back(word);
        bare.push_back(std::to_string(number));
        shown.push_back(word + "->" + bare.back());
    }
    range = "value in " + braced(shown) + " OR " + braced(bare);
    numbers = std::move(words);
    check = Check::number;
    return *this;
}

Option& Option::inRange(double least, double most, std::string words) {
    low = least;
    high = most;
    range = std::move(words);
    check = Check::range;
    const auto isOutside = [&](auto into) {
        if constexpr (std::is_pointer_v<decltype(into)>)
            if constexpr (std::is_arithmetic_v<std::remove_pointer_t<decltype(into)>>)
                return static_cast<double>(*into) < least;
        return false;
    };
    return std::visit(isOutside, target) ? unshown() : *this;
}

OptionTable::OptionTable(std::string calledBy, std::string says)
    : words{std::move(calledBy)}
    , meaning{std::move(says)} {
    addRow("-h,--help", {}, "Print this help message and exit");
}

Option& OptionTable::addRow(const std::string& names, OptionTarget target, std::string says) {
    Option& made = options.emplace_back();
    made.spellings = split(names);
    made.isPlace = !names.starts_with('-');
    made.meaning = std::move(says);
    if (made.isPlace && names == "scene") made.choices = sceneNames();
    const auto describe = [&](auto into) {
        if constexpr (std::is_pointer_v<decltype(into)>) {
            made.type = typeOf(into);
            made.initial = initialOf(into);
        }
    };
    std::visit(describe, target);
    made.target = std::move(target);
    return made;
}

Option& OptionTable::addRead(const std::string& names, std::string initial, WordReader reader,
                             std::string says) {
    Option& made = addRow(names, std::move(reader), std::move(says)).as("TEXT");
    made.initial = std::move(initial);
    return made;
}

OptionTable& OptionTable::addCommand(const std::string& name, std::string says) {
    return commands.emplace_back(words + ' ' + name, std::move(says));
}

void OptionTable::addVersion(std::string answer) {
    version = std::move(answer);
    addRow("--version", {}, "Display program version information and exit");
}

const OptionTable* OptionTable::called() const { return calls.empty() ? nullptr : calls.front(); }

void addUsage(OptionTable& program, std::string_view usage) {
    program.usage = usage;
    program.options.clear();
    const std::regex shown{"(--[a-z][a-z-]*)( [A-Z][A-Z.:]*)?"};
    for (auto found = std::sregex_iterator{program.usage.begin(), program.usage.end(), shown};
         found != std::sregex_iterator{}; ++found) {
        const std::string name = found->str(1), value = found->str(2);
        const auto isSame = [&](const Option& option) { return option.spellings.front() == name; };
        if (std::ranges::none_of(program.options, isSame))
            program.addRow(name, {}, {}).as(value.empty() ? value : value.substr(1));
    }
}

} // namespace physvib
