// SPDX-License-Identifier: GPL-3.0-or-later
// What a program can be told, as a table: a row per option says its name, its words, what it takes and where
// the value goes. The parser,
// --help, manual pages and completions are made from it.
#pragma once
#include <cstddef>
#include <cstdint>
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

/// Reads a word, or all that were said, into a value; what it expected instead, or empty.
using WordReader = std::function<std::string(const std::string&)>;
using WordsReader = std::function<std::string(const std::vector<std::string>&)>;

/// Where a value goes. A bool: the option takes none. A function of a number: of one of several words, each
/// with a number.
using OptionTarget =
    std::variant<std::monostate, bool*, int*, std::uint32_t*, std::size_t*, double*, std::string*,
                 std::vector<std::string>*, std::optional<int>*, std::optional<double>*,
                 std::optional<std::string>*, std::function<void(int)>, WordReader, WordsReader>;

/// One row. What is said of it returns the row. M only.
struct Option {
    std::vector<std::string> spellings; ///< "-h", "--help"; of a word that has only a place: its name
    OptionTarget target;
    std::string meaning;
    std::string type;                 ///< what follows it: "FLOAT"; empty: nothing does
    std::string initial;              ///< what it is if nobody says it; empty: nothing that is shown
    std::string group;                ///< its heading in --help; empty: the usual one
    std::string range;                ///< what its values have to be: "0 to 1", "{on,off}"; empty: anything
    std::vector<std::string> choices; ///< all that it may be, or some that are built in
    std::vector<std::pair<std::string, int>> numbers; ///< of a function: its words
    double low = 0.0, high = 0.0;
    enum class Check { none, range, positive, choice, number, folder, ending } check = Check::none;
    bool isPlace = false, isRequired = false, isWritten = false, isSingle = false;
    int mostListed = 0; ///< values that one word may hold, with commas between them; 0: a word is a value

    std::vector<std::string> said; ///< after parsing: the words of the call

    Option& as(std::string words) { return type = std::move(words), *this; }
    /// It names a file that is written; all others may name files that are read.
    Option& written(std::string words) { return isWritten = true, as(std::move(words)); }
    /// The same; the name has to end as that of `file`, "FILE.png": programs tell from it what a file is.
    Option& writtenAs(std::string file) { return check = Check::ending, written(std::move(file)); }
    Option& required() { return isRequired = true, *this; }
    Option& under(std::string heading) { return group = std::move(heading), *this; }
    Option& unshown() { return initial.clear(), *this; } ///< its words say what it is if nobody says it
    Option& single() { return isSingle = true, *this; }  ///< it may be repeated, with a value each time
    Option& listed(int most) { return mostListed = most, *this; }
    Option& existingFolder() { return range = "DIR", check = Check::folder, *this; }
    /// more than 0, and finite
    Option& positive() { return range = "POSITIVE", check = Check::positive, unshown(); }
    Option& oneOf(std::vector<std::string> words);
    Option& numbered(std::vector<std::pair<std::string, int>> words); ///< of a function

    /// Both inclusive; `unit` with the space before it. A value from outside, which nobody can say, is not
    /// shown.
    template <class T>
    Option& in(T least, T most, const std::string& unit = {}) {
        std::ostringstream words;
        words << least << " to " << most << unit;
        return inRange(static_cast<double>(least), static_cast<double>(most), words.str());
    }

    /// What follows it, for people: "FLOAT:0 to 1".
    std::string value() const { return range.empty() ? type : type + ':' + range; }

private:
    Option& inRange(double least, double most, std::string words);
};

/// The options of a program or of a command, and the commands within it. Rows stay where they are. M only.
class OptionTable {
public:
    OptionTable(std::string words, std::string meaning);
    OptionTable(const OptionTable&) = delete;
    OptionTable& operator=(const OptionTable&) = delete;

    /// `names`: "--seed", "--plan,--dry-run", or "scene" for a word that has only a place. `value` outlives
    /// the table's parsing, and holds what it is if nobody says it.
    template <class T>
    Option& add(const std::string& names, T& value, std::string says) {
        return addRow(names, &value, std::move(says));
    }
    /// A value that text has to be read for; `initial` is its word if nobody says one.
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
    void addVersion(std::string answer); ///< --version, with what it says

    /// After parsing: the command that was called; none: this one itself.
    const OptionTable* called() const;
    bool isCalled(std::string_view name) const { return called() != nullptr && called()->name() == name; }
    std::string name() const { return words.substr(words.rfind(' ') + 1); }

    std::string words;   ///< "physvib analyse anova"
    std::string meaning; ///< a line
    std::string usage;   ///< lines of a program that says them itself; else they are made from the options
    std::string version; ///< see addVersion
    std::string alias;   ///< another name of the command
    std::list<Option> options;
    std::list<OptionTable> commands;
    std::vector<const OptionTable*> calls; ///< after parsing: of `commands`, those of the call
};

/// Of a program that has words instead of a parser: its options are those that its usage shows. M.
void addUsage(OptionTable& program, std::string_view usage);

} // namespace physvib
