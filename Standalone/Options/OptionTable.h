// SPDX-License-Identifier: GPL-3.0-or-later
// Table of a program's options and commands: names, help texts, valid values and targets. Parser, --help,
// manual pages and completions are generated from it. All for the message thread.
#pragma once
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <optional>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace physvib {

/// Converts one argument of an option, or all of them, to a value. Returns "", or what was expected.
using WordReader = std::function<std::string(const std::string&)>;
using WordsReader = std::function<std::string(const std::vector<std::string>&)>;

/// Destination of an option's value. bool*: the option has no value. A function of int: the value is one of
/// several words, each of which stands for a number.
using OptionTarget =
    std::variant<std::monostate, bool*, int*, std::uint32_t*, std::size_t*, double*, std::string*,
                 std::vector<std::string>*, std::optional<int>*, std::optional<double>*,
                 std::optional<std::string>*, std::function<void(int)>, WordReader, WordsReader>;

/// One option. Setters return the option for chaining.
struct Option {
    std::vector<std::string> spellings; ///< "-h", "--help"; or the name of a positional argument
    OptionTarget target;
    std::string meaning;
    std::string type;                                 ///< type of its value: "FLOAT"; empty: none
    std::string initial;                              ///< default; empty: not shown
    std::string group;                                ///< heading above it in --help; empty: the default one
    std::string range;                                ///< valid values: "0 to 1", "{on,off}"; empty: any
    std::vector<std::string> choices;                 ///< all valid values, or some built-in ones
    std::vector<std::pair<std::string, int>> numbers; ///< words and numbers of a function target
    std::string replacement; ///< for a deprecated option, printed once on stderr; empty: not deprecated
    double minValue = 0.0, maxValue = 0.0; ///< limits of a range, inclusive
    enum class Check { none, range, positive, choice, number, folder, ending } check = Check::none;
    bool isPositional = false, isRequired = false, isOutputFile = false, isSingle = false;
    int maxValues = 0; ///< maximum number of comma-separated values in one argument; 0: not separated

    std::vector<std::string> arguments; ///< after parsing: the arguments in the call

    /// Sets the name of its value in help texts, "FILE.wav".
    Option& as(std::string words) { return type = std::move(words), *this; }
    /// Marks an output file; all other arguments may name input files.
    Option& outputFile(std::string words) { return isOutputFile = true, as(std::move(words)); }
    /// Marks an output file that must have the extension of `file` ("FILE.png").
    Option& outputFileNamed(std::string file) { return check = Check::ending, outputFile(std::move(file)); }
    Option& deprecated(std::string words) { return replacement = std::move(words), *this; }
    Option& required() { return isRequired = true, *this; }
    Option& inGroup(std::string heading) { return group = std::move(heading), *this; }
    Option& hideDefault() { return initial.clear(), *this; } ///< the help text describes the default
    Option& single() { return isSingle = true, *this; }      ///< may be repeated, with one value each time
    Option& separated(int max) { return maxValues = max, *this; }
    Option& existingFolder() { return range = "DIR", check = Check::folder, *this; }
    /// Restricts the value to finite numbers above 0.
    Option& positive() { return range = "POSITIVE", check = Check::positive, hideDefault(); }
    Option& oneOf(std::vector<std::string> words);
    Option& numbered(std::vector<std::pair<std::string, int>> words); ///< for a function target

    /// Sets an inclusive range; `unit` begins with a space. A default below it is not shown.
    template <class T>
    Option& in(T min, T max, const std::string& unit = {}) {
        std::ostringstream words;
        words << min << " to " << max << unit;
        return inRange(static_cast<double>(min), static_cast<double>(max), words.str());
    }

    /// Type and range of its value for help: "FLOAT:0 to 1".
    std::string value() const { return range.empty() ? type : type + ':' + range; }

private:
    Option& inRange(double min, double max, std::string rangeText);
};

/// Options of a program or command, and its subcommands. Entries have stable addresses.
class OptionTable {
public:
    OptionTable(std::string words, std::string meaning);
    OptionTable(const OptionTable&) = delete;
    OptionTable& operator=(const OptionTable&) = delete;

    /// `names`: "--seed", "--plan,--dry-run", or "scene" for a positional argument. `value` holds the default
    /// and must outlive parsing.
    template <class T>
    Option& add(const std::string& names, T& value, std::string help) {
        return addRow(names, &value, std::move(help));
    }
    /// An option whose text is converted by `reader`; `initial` is the default's text.
    Option& addRead(const std::string& names, std::string initial, WordReader reader, std::string help);
    /// An option with one of several values, each of which has a word.
    template <class T>
    Option& addOneOf(const std::string& names, T& value, std::vector<std::pair<std::string, T>> all,
                     std::string help) {
        std::vector<std::string> choices;
        std::string initial;
        for (const auto& [word, choice] : all) {
            choices.push_back(word);
            if (choice == value) initial = word;
        }
        const auto read = [&value, all](const std::string& argument) {
            for (const auto& [word, choice] : all)
                if (word == argument) value = choice;
            return std::string{};
        };
        return addRead(names, initial, read, std::move(help)).oneOf(std::move(choices));
    }
    Option& addSwitch(const std::string& names, bool& value, std::string help) {
        return addOneOf<bool>(names, value, {{"on", true}, {"off", false}}, std::move(help));
    }
    Option& addRow(const std::string& names, OptionTarget target, std::string help);
    OptionTable& addCommand(const std::string& name, std::string meaning);
    void addVersion(std::string answer); ///< adds --version with that output

    /// After parsing: the called subcommand; null if there is none.
    const OptionTable* called() const;
    bool isCalled(std::string_view name) const { return called() != nullptr && called()->name() == name; }
    std::string name() const { return words.substr(words.rfind(' ') + 1); }

    std::string words;   ///< the command as it is called: "physvib analyse confusion"
    std::string meaning; ///< one line
    std::string usage;   ///< own usage text; empty: generated from the options
    std::string version; ///< see addVersion
    std::string alias;   ///< alternative name of the command
    std::list<Option> options;
    std::list<OptionTable> commands;
    std::vector<const OptionTable*> calls; ///< after parsing: called entries of `commands`
};

/// Replaces the options by those in the usage text of a program that does not use this table.
void addUsage(OptionTable& program, std::string_view usage);

/// Appends the comma-separated numbers of `text`; false if it is empty or contains anything else.
template <class Number>
bool parseNumbers(const std::string& text, std::vector<Number>& numbers) {
    const char* const end = text.data() + text.size();
    for (const char* next = text.data();; ++next) {
        Number number{};
        const auto [stop, error] = std::from_chars(next, end, number);
        if (error != std::errc{} || (stop != end && *stop != ',')) return false;
        numbers.push_back(number);
        next = stop;
        if (next == end) return true;
    }
}

/// Result of parsing; if `error` is empty, the table's targets have their values.
struct ParseResult {
    std::string error;   ///< error in one line
    std::string unknown; ///< the first unknown argument
    std::string help;    ///< output of --help or --version; then `error` is no error

    /// The error line to be printed.
    std::string reason() const { return unknown.empty() ? error : "unknown: " + unknown; }
};

/// Parses a program's arguments, and prints notes on deprecated options.
ParseResult parseArguments(OptionTable& table, int argc, char** argv);

/// Parses a call given as text without the program's name: "render drop --law=log".
ParseResult parseText(OptionTable& table, const std::string& call);

/// Option that requests the reference, followed by a folder. Undocumented: only the build uses it.
inline constexpr const char* referenceWord = "--reference";

/// Writes man1/, md/ (Docs/commands.md), bash/, zsh/ and fish/ into the folder. Empty, or one error line.
std::string writeReference(const OptionTable& program, const std::filesystem::path& folder);

} // namespace physvib
