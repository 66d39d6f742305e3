// SPDX-License-Identifier: GPL-3.0-or-later
// Writes completion scripts for bash, zsh and fish. The bash and zsh scripts determine the command from the
// words typed so far.
#include "Options/Completions.h"
#include "Io/Text/NameList.h"
#include <functional>
#include <sstream>

namespace physvib {
namespace {

using Visit = std::function<void(const OptionTable&)>;

void each(const OptionTable& command, const Visit& visit) {
    visit(command);
    for (const OptionTable& inner : command.commands) each(inner, visit);
}

std::string bracketed(const std::vector<std::string>& words) {
    std::string out = joined(words, " ");
    out.insert(out.begin(), '(');
    out += ')';
    return out;
}

std::vector<std::string> namesWithin(const OptionTable& command) {
    std::vector<std::string> names;
    for (const OptionTable& inner : command.commands) names.push_back(inner.name());
    return names;
}

/// A function name without hyphens, which not all shells allow.
std::string functionOf(const OptionTable& program) {
    std::string name(1, '_');
    for (const char c : program.words) name += c == '-' ? '_' : c;
    return name;
}

/// "physvib render"|"physvib play": a pattern of all calls of commands.
std::string allCalls(const OptionTable& program) {
    std::string calls;
    each(program, [&](const OptionTable& command) {
        if (&command != &program) (calls += calls.empty() ? "" : "|") += shellWord(command.words);
    });
    return calls.empty() ? "''" : calls;
}

void heading(std::ostream& out, const OptionTable& program) {
    out << "# SPDX-License-Identifier: GPL-3.0-or-later\n# Completions of " << program.words << ".\n";
}

/// Text of one zsh option: '--law[panning law]:TEXT:(linear log)'.
std::string zshOption(const Option& option, const std::string& spelling) {
    std::string text = spelling;
    text += '[';
    for (const char c : option.meaning) {
        if (std::string_view{"[]:\\"}.find(c) != std::string_view::npos) text += '\\';
        text += c;
    }
    text += ']';
    if (!option.value().empty())
        (text += ": :") += option.choices.empty() ? "_files" : bracketed(option.choices);
    return shellWord(text);
}

std::string zshPlace(const OptionTable& command) {
    if (!command.commands.empty())
        return shellWord(std::string{"*: :"}.append(bracketed(namesWithin(command))));
    for (const Option& option : command.options)
        if (option.isPlace && !option.choices.empty())
            return shellWord(std::string{"*: :{_alternative \"n: :"}.append(bracketed(option.choices)) +
                             "\" \"f: :_files\"}");
    return "'*: :_files'";
}

std::string fishCondition(const OptionTable& program, const OptionTable& command) {
    if (program.commands.empty()) return {};
    if (&command == &program) return " -n __fish_use_subcommand";
    std::string condition;
    std::istringstream words{command.words.substr(program.words.size())};
    for (std::string word; words >> word;)
        condition +=
            (condition.empty() ? "__fish_seen_subcommand_from " : "; and __fish_seen_subcommand_from ") +
            word;
    if (!command.commands.empty())
        (condition += "; and not __fish_seen_subcommand_from ") += joined(namesWithin(command), " ");
    return std::string{" -n "}.append(shellWord(condition));
}

std::string fishOption(const Option& option) {
    std::string words;
    if (!option.isPlace)
        for (const std::string& name : option.spellings)
            words += name.starts_with("--") ? std::string{" -l "}.append(name, 2)
                                            : std::string{" -s "}.append(name, 1);
    if (!option.choices.empty())
        words +=
            std::string{option.isPlace ? " -a " : " -x -a "}.append(shellWord(joined(option.choices, " ")));
    else if (!option.isPlace && !option.value().empty())
        words += " -r";
    if (!option.meaning.empty()) (words += " -d ") += shellWord(option.meaning);
    return words;
}

} // namespace

std::string bashCompletion(const OptionTable& program) {
    std::ostringstream out;
    heading(out, program);
    out << functionOf(program) << "() {\n    local word call=" << program.words << " choices=\n"
        << "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
        << "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case \"$call $word\" in "
        << allCalls(program) << ") call=\"$call $word\" ;; esac\n    done\n"
        << "    case \"$call $previous\" in\n";
    each(program, [&](const OptionTable& command) {
        for (const Option& option : command.options)
            for (const std::string& name : option.spellings)
                if (!option.isPlace && !option.value().empty())
                    out << "        " << shellWord(command.words + ' ' + name) << ") "
                        << (option.choices.empty()
                                ? "return"
                                : std::string{"choices="}.append(shellWord(joined(option.choices, " "))))
                        << " ;;\n";
    });
    out << "    esac\n    [ -n \"$choices\" ] || case $call in\n";
    each(program, [&](const OptionTable& command) {
        std::vector<std::string> words = namesWithin(command);
        for (const Option& option : command.options) {
            const auto& more = option.isPlace ? option.choices : option.spellings;
            words.insert(words.end(), more.begin(), more.end());
        }
        out << "        " << shellWord(command.words) << ") choices=" << shellWord(joined(words, " "))
            << " ;;\n";
    });
    out << "    esac\n    COMPREPLY=($(compgen -W \"$choices\" -- \"$current\"))\n}\ncomplete -o default -F "
        << functionOf(program) << ' ' << program.words << '\n';
    return out.str();
}

std::string zshCompletion(const OptionTable& program) {
    std::ostringstream out;
    out << "#compdef " << program.words << '\n';
    heading(out, program);
    out << "local word call=" << program.words
        << "\nfor word in ${words[2,CURRENT-1]}; do\n    case \"$call $word\" in (" << allCalls(program)
        << ") call=\"$call $word\" ;; esac\ndone\ncase $call in\n";
    each(program, [&](const OptionTable& command) {
        out << "    (" << shellWord(command.words) << ") _arguments";
        for (const Option& option : command.options)
            for (const std::string& name : option.spellings)
                if (!option.isPlace) out << " \\\n        " << zshOption(option, name);
        out << " \\\n        " << zshPlace(command) << " ;;\n";
    });
    out << "esac\n";
    return out.str();
}

// Fish evaluates a condition for each proposal: those of a command apply after its words, until a subcommand
// follows.
std::string fishCompletion(const OptionTable& program) {
    std::ostringstream out;
    heading(out, program);
    each(program, [&](const OptionTable& command) {
        const std::string begin = "complete -c " + program.words + fishCondition(program, command);
        for (const OptionTable& inner : command.commands)
            out << begin << " -f -a " << inner.name() << " -d " << shellWord(inner.meaning) << '\n';
        for (const Option& option : command.options) out << begin << fishOption(option) << '\n';
    });
    return out.str();
}

} // namespace physvib
