// SPDX-License-Identifier: GPL-3.0-or-later
// Creates option entries: their type and default come from the target, or all comes from a usage text.
#include "Options/OptionTable.h"
#include "Io/Text/NameList.h"
#include "Scene/SceneFile.h"
#include <algorithm>
#include <regex>
#include <type_traits>

namespace physvib {
namespace {

template <class T>
std::string typeName(const T*) {
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
std::string defaultText(const T* target) {
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

std::string inBraces(const std::vector<std::string>& words) { return '{' + joinNames(words, ",") + '}'; }

std::vector<std::string> sceneNames() {
    std::vector<std::string> names;
    for (const EmbeddedFile& file : embeddedScenes()) // reading the scenes would take too long
        names.emplace_back(file.name.substr(0, file.name.rfind('.')));
    return names;
}

} // namespace

Option& Option::oneOf(std::vector<std::string> words) {
    range = inBraces(words);
    choices = std::move(words);
    check = Check::choice;
    return *this;
}

Option& Option::numbered(std::vector<std::pair<std::string, int>> words) {
    std::ranges::sort(words);
    std::vector<std::string> wordTexts, numberTexts;
    for (const auto& [word, number] : words) {
        choices.push_back(word);
        numberTexts.push_back(std::to_string(number));
        wordTexts.push_back(word + "->" + numberTexts.back());
    }
    range = "value in " + inBraces(wordTexts) + " OR " + inBraces(numberTexts);
    numbers = std::move(words);
    check = Check::number;
    return *this;
}

Option& Option::inRange(double min, double max, std::string rangeText) {
    minValue = min;
    maxValue = max;
    range = std::move(rangeText);
    check = Check::range;
    const auto isOutside = [&](auto alternative) {
        if constexpr (std::is_pointer_v<decltype(alternative)>)
            if constexpr (std::is_arithmetic_v<std::remove_pointer_t<decltype(alternative)>>)
                return static_cast<double>(*alternative) < min;
        return false;
    };
    return std::visit(isOutside, target) ? hideDefault() : *this;
}

OptionTable::OptionTable(std::string callWords, std::string help)
    : words{std::move(callWords)}
    , meaning{std::move(help)} {
    addRow("-h,--help", {}, "Print this help message and exit");
}

Option& OptionTable::addRow(const std::string& names, OptionTarget target, std::string help) {
    Option& option = options.emplace_back();
    option.spellings = split(names);
    option.isPositional = !names.starts_with('-');
    option.meaning = std::move(help);
    if (option.isPositional && names == "scene") option.choices = sceneNames();
    const auto describe = [&](auto alternative) {
        if constexpr (std::is_pointer_v<decltype(alternative)>) {
            option.type = typeName(alternative);
            option.initial = defaultText(alternative);
        }
    };
    std::visit(describe, target);
    option.target = std::move(target);
    return option;
}

Option& OptionTable::addRead(const std::string& names, std::string initial, WordReader reader,
                             std::string help) {
    Option& option = addRow(names, std::move(reader), std::move(help)).as("TEXT");
    option.initial = std::move(initial);
    return option;
}

OptionTable& OptionTable::addCommand(const std::string& name, std::string help) {
    return commands.emplace_back(words + ' ' + name, std::move(help));
}

void OptionTable::addVersion(std::string answer) {
    version = std::move(answer);
    addRow("--version", {}, "Display program version information and exit");
}

const OptionTable* OptionTable::called() const { return calls.empty() ? nullptr : calls.front(); }

void addUsage(OptionTable& program, std::string_view usage) {
    program.usage = usage;
    program.options.clear();
    const std::regex optionPattern{"(--[a-z][a-z-]*)( [A-Z][A-Z.:]*)?"};
    for (auto found = std::sregex_iterator{program.usage.begin(), program.usage.end(), optionPattern};
         found != std::sregex_iterator{}; ++found) {
        const std::string name = found->str(1), value = found->str(2);
        const auto isSame = [&](const Option& option) { return option.spellings.front() == name; };
        if (std::ranges::none_of(program.options, isSame))
            program.addRow(name, {}, {}).as(value.empty() ? value : value.substr(1));
    }
}

} // namespace physvib
