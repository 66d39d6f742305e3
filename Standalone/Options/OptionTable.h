// SPDX-License-Identifier: GPL-3.0-or-later
// Table of a program's options: each entry has the option's name, help text, valid values and target. The
// parser, --help, manual pages and completions are generated from it.
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

/// Converts one argument, or all of an option, to a value. Returns what was expected instead, or "".
using WordReader = std::function<std::string(const std::string&)>;
using WordsReader = std::function<std::string(const std::vector<std::string>&)>;

/// Destination of an option's value. bool: the option has no value. A function of a number: the option has
/// one of several words, each with a number.
using OptionTarget =
    std::variant<std::monostate, bool*, int*, std::uint32_t*, std::size_t*, double*, std::string*,
                 std::vector<std::string>*, std::optional<int>*, std::optional<double>*,
                 std::optional<std::string>*, std::function<void(int)>, WordReader, WordsReader>;

/// One option. Setters return the option for chaining. Message thread.
struct Option {
    std::vector<std::string> spellings; ///< "-h", "--help"; the name of a positional argument
    OptionTarget target;
    std::string meaning;
    std::string type;                                 ///< type of its value: "FLOAT"; empty: none
    std::string initial;                              ///< default; empty: not shown
    std::string group;                                ///< its heading in --help; empty: the default one
    std::string range;                                ///< valid values: "0 to 1", "{on,off}"; empty: any
    std::vector<std::string> choices;                 ///< all valid values, or some built-in ones
    std::vector<std::pair<std::string, int>> numbers; ///< words and numbers of a function target
    std::string instead; ///< for a deprecated option, printed once on stderr; empty: not deprecated
    double low = 0.0, high = 0.0;
    enum class Check { none, range, positive, choice, number, folder, ending } check = Check::none;
    bool isPlace = false, isRequired = false, isWritten = false, isSingle = false;
    int mostListed = 0; ///< maximum number of comma-separated values in one argument; 0: not separated

    std::vector<std::string> said; ///< after parsing: the arguments in the call

    Option& as(std::string words) { return type = std::move(words), *this; }
    /// Marks an output file; all other arguments may name input files.
    Option& written(std::string words) { return isWritten = true, as(std::move(words)); }
    /// The same, for a name that must have the extension of `file`, "FILE.png", because programs derive the
    /// format from it.
    Option& writtenAs(std::string file) { return check = Check::ending, written(std::move(file)); }
    Option& deprecated(std::string words) { return instead = std::move(words), *this; }
    Option& required() { return isRequired = true, *this; }
    Option& under(std::string heading) { return group = std::move(heading), *this; }
    Option& unshown() { return initial.clear(), *this; } ///< the help text describes the default
    Option& single() { return isSingle = true, *this; }  ///< may be repeated, with one value each time
    Option& listed(int most) { return mostListed = most, *this; }
    Option& existingFolder() { return range = "DIR", check = Check::folder, *this; }
    /// Finite and greater than 0.
    Option& positive() { return range = "POSITIVE", check = Check::positive, unshown(); }
    Option& oneOf(std::vector<std::string> words);
    Option& numbered(std::vector<std::pair<std::string, int>> words); ///< for a function target

    /// Inclusive range; `unit` starts with a space. A default outside the range is not shown.
    template <class T>
    Option& in(T least, T most, const std::string& unit = {}) {
        std::ostringstream words;
        words << least << " to " << most << unit;
        return inRange(static_cast<double>(least), static_cast<double>(most), words.str());
    }

    /// Type and range of its value for help: "FLOAT:0 to 1".
    std::string value() const { return range.empty() ? type : type + ':' + range; }

private:
    Option& inRange(double least, double most, std::string words);
};

/// Options of a program or command, and its subcommands. Entries have stable addresses. Message thread.
class OptionTable {
public:
    OptionTable(std::string words, std::string meaning);
    OptionTable(const OptionTable&) = delete;
    OptionTable& operator=(const OptionTable&) = delete;

    /// `names`: "--seed", "--plan,--dry-run", or "scene" for a positional argument. `value` holds the default
    /// and must outlive parsing.
    template <class T>
    Option& add(const std::string& names, T& value, std::string says) {
        return addRow(names, &value, std::move(says));
    }
    /// An option whose text is converted by `reader`; `initial` is the default's text.
    Option& addRead(const std::string& names, std::string initial, WordReader reader, std::string says);
    /// One of several values, each with its word.
    template <class T>
    Option& addOneOf(const std::string& names, T& value, std::vector<std::pair<std::string, T>> all,
                     std::string says) {
        std::vector<std::string> choices;
        std::string initial;
        for (const auto& [word, of] : all) {
            choices.push_back(word);
            if (of == value) initial = word;
        }
        const auto read = [&value, all](const std::string& said) {
            for (const auto& [word, of] : all)
                if (word == said) value = of;
            return std::string{};
        };
        return addRead(names, initial, read, std::move(says)).oneOf(std::move(choices));
    }
    Option& addSwitch(const std::string& names, bool& value, std::string says) {
        return addOneOf<bool>(names, value, {{"on", true}, {"off", false}}, std::move(says));
    }
    Option& addRow(const std::string& names, OptionTarget target, std::string says);
    OptionTable& addCommand(const std::string& name, std::string meaning);
    void addVersion(std::string answer); ///< adds --version with that output

    /// After parsing: the called subcommand; null if there is none.
    const OptionTable* called() const;
    bool isCalled(std::string_view name) const { return called() != nullptr && called()->name() == name; }
    std::string name() const { return words.substr(words.rfind(' ') + 1); }

    std::string words;   ///< its words in a call: "physvib analyse confusion"
    std::string meaning; ///< one line
    std::string usage;   ///< own usage text; empty: generated from the options
    std::string version; ///< see addVersion
    std::string alias;   ///< alternative name of the command
    std::list<Option> options;
    std::list<OptionTable> commands;
    std::vector<const OptionTable*> calls; ///< after parsing: called entries of `commands`
};

/// Adds options from the usage text of a program without a parser. Message thread.
void addUsage(OptionTable& program, std::string_view usage);

/// Appends the comma-separated numbers of `text`; false if it is empty or contains anything else.
template <class Number>
bool parseNumbers(const std::string& text, std::vector<Number>& numbers) {
    const char* const end = text.data() + text.size();
    for (const char* at = text.data();; ++at) {
        Number number{};
        const auto [stop, error] = std::from_chars(at, end, number);
        if (error != std::errc{} || (stop != end && *stop != ',')) return false;
        numbers.push_back(number);
        at = stop;
        if (at == end) return true;
    }
}

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

/// Option that requests the reference, followed by a folder. Undocumented: only the build uses it.
inline constexpr const char* referenceWord = "--reference";

/// Writes man1/, md/ (Docs/commands.md), bash/, zsh/ and fish/ into the folder. Empty, or one error line. M.
std::string writeReference(const OptionTable& program, const std::filesystem::path& folder);

} // namespace physvib
