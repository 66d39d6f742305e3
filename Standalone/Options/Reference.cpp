// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the reference of a program for installation: a page in Markdown, manual pages in roff, and
// completions for bash, zsh and fish.
#include "Io/Disk/AtomicFile.h"
#include "Io/Text/NameList.h"
#include "Options/OptionTable.h"
#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <map>
#include <sstream>
#include <system_error>

namespace physvib {
namespace {

/// Escapes the text of a table cell.
std::string tableCell(std::string_view text) {
    std::string out;
    for (const char c : text)
        out += c == '|' ? std::string{"\\|"} : c == '\n' ? std::string{" "} : std::string{c};
    return out;
}

std::string toCode(const std::string& text) { return text.empty() ? text : '`' + tableCell(text) + '`'; }

std::string spellingList(const Option& option) {
    std::string out;
    for (const std::string& spelling : option.spellings) out += (out.empty() ? "" : ", ") + toCode(spelling);
    return out;
}

bool isListed(const Option& option) {
    return !option.meaning.empty() && std::ranges::find(option.spellings, "--help") == option.spellings.end();
}

/// Table rows that were written, each with the first command that has it.
using WrittenRows = std::map<std::string, std::string>;

void writeOptionTable(std::ostream& out, const OptionTable& command, WrittenRows& writtenRows) {
    std::string table;
    std::map<std::string, std::string> repeatedOptions; // by the command whose table has them
    for (const Option& option : command.options) {
        if (!isListed(option)) continue;
        const std::string row = "| " + spellingList(option) + " | " +
                                toCode(option.isPositional ? option.range : option.value()) + " | " +
                                toCode(option.initial) + " | " + tableCell(option.meaning) +
                                (option.isRequired ? " (required) |\n" : " |\n");
        const auto [firstUse, isNew] = writtenRows.emplace(row, command.words);
        if (isNew)
            table += row;
        else
            repeatedOptions[firstUse->second] +=
                (repeatedOptions[firstUse->second].empty() ? "" : ", ") + spellingList(option);
    }
    if (!table.empty())
        out << "\n| option | value | default | meaning |\n| --- | --- | --- | --- |\n" << table;
    for (const auto& [other, names] : repeatedOptions) out << "\nAs `" << other << "`: " << names << ".\n";
}

void writeSection(std::ostream& out, const OptionTable& command, const std::string& heading,
                  WrittenRows& writtenRows) {
    std::string sentence = command.meaning + '.';
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    out << '\n' << heading << " `" << command.words << '`';
    if (!command.alias.empty()) out << ", `" << command.alias << '`';
    out << '\n' << sentence << '\n';
    writeOptionTable(out, command, writtenRows);
    for (const OptionTable& inner : command.commands) writeSection(out, inner, heading + '#', writtenRows);
}

/// Markdown with a table of options for each command of a program. Message thread.
std::string markdownPage(const OptionTable& program) {
    std::ostringstream out;
    WrittenRows writtenRows;
    out << "<!-- SPDX-License-Identifier: MIT -->\n<!-- Generated: " << program.words
        << " --reference FOLDER, and FOLDER/md/" << program.words << ".md -->\n# Commands and options\n\n"
        << "Every command of `" << program.words << "` with its options. `" << program.words
        << " COMMAND --help` and `man " << program.words
        << "-COMMAND` print the same. Options of ranges refuse other values.\n";
    writeOptionTable(out, program, writtenRows);
    for (const OptionTable& command : program.commands) writeSection(out, command, "##", writtenRows);
    return out.str();
}

/// Escapes text for man: hyphens can be copied, and no line is read as a request.
std::string manText(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\')
            out += "\\e";
        else if (c == '-')
            out += "\\-";
        else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n'))
            (out += "\\&") += c;
        else
            out += c;
    }
    return out;
}

std::string upperCase(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) {
        return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    });
    return text;
}

void writeOption(std::ostream& out, const Option& option) {
    const std::string name = manText(joinNames(option.spellings, ", "));
    out << ".TP\n" << (option.isPositional ? "\\fI" : "\\fB") << name << "\\fR";
    if (!option.value().empty() && !option.isPositional) out << " \\fI" << manText(option.value()) << "\\fR";
    if (!option.initial.empty()) out << " (" << manText(option.initial) << ')';
    out << '\n' << manText(option.meaning) << '\n';
}

void writeCallOption(std::ostream& out, const Option& option) {
    const std::string name = manText(option.spellings.back());
    out << (option.isRequired ? " " : " [")
        << (option.isPositional ? "\\fI" + name : "\\fB" + name + "\\fR \\fI" + manText(option.value()))
        << (option.isRequired ? "\\fR" : "\\fR]");
}

void writeCall(std::ostream& out, const OptionTable& command) {
    if (!command.usage.empty()) {
        out << ".nf\n" << manText(command.usage) << ".fi\n";
        return;
    }
    out << "\\fB" << manText(command.words) << "\\fR [\\fIoptions\\fR]";
    for (const Option& option : command.options)
        if (option.isPositional || option.isRequired) writeCallOption(out, option);
    out << (command.commands.empty() ? "\n" : " \\fIcommand\\fR ...\n");
}

void writeOptions(std::ostream& out, const OptionTable& command) {
    for (const Option& option : command.options)
        if (!option.meaning.empty()) writeOption(out, option);
}

/// "physvib render" as "physvib-render", the name of its page.
std::string pageName(const OptionTable& command) {
    std::string name = command.words;
    std::ranges::replace(name, ' ', '-');
    return name;
}

/// Writes the commands of a program as a list, because each has its own page; subcommands in full.
void writeCommands(std::ostream& out, const OptionTable& command) {
    if (command.commands.empty()) return;
    const bool isProgram = command.words.find(' ') == std::string::npos;
    out << ".SH COMMANDS\n";
    for (const OptionTable& inner : command.commands) {
        if (isProgram) {
            out << ".TP\n\\fB" << manText(pageName(inner)) << "\\fR(1)\n" << manText(inner.meaning) << '\n';
            continue;
        }
        out << ".SS " << manText(inner.words) << '\n' << manText(inner.meaning) << "\n.PP\n";
        writeCall(out, inner);
        writeOptions(out, inner);
    }
}

/// Introduction to a program or command, in addition to its one-line meaning.
struct Description {
    std::string_view page, text;
};
constexpr auto descriptions = std::to_array<Description>({
    {"physvib", "PhysVib turns physics collisions into vibrotactile signals. Each contact excites a decaying "
                "sinusoid, which is panned over 1 to 64 actuators so that it is felt at "
                "the contact point. physvib renders and plays scenes, runs and analyses perception studies, "
                "and measures materials and actuators. Begin with \"physvib scenes\" and "
                "\"physvib render shake-the-box --out box.wav\". Hands are attached to these motors: start "
                "with the amplifier at its lowest setting."},
    {"physvib-mixer", "Shows a physics world, plays it on the actuators that are attached, and mixes them "
                      "like the channels of an audio mixer. FILE.json is a session, a scene or a layout. "
                      "Without a device the world still runs and can be recorded. Esc silences everything "
                      "within a block. With two outputs and no actuators, the monitor plays what "
                      "would be felt on headphones."},
    {"physvib-render", "Simulates a scene, or reads an event list, a saved session or a haptic file, and "
                       "writes what each actuator plays: a WAV file with one channel per actuator, an event "
                       "list, a picture, a movie. It is faster than real time and repeatable: the same input "
                       "and options give the same bytes. All files appear at the end, or none."},
    {"physvib-play",
     "Plays a scene live on an audio device, a four-channel board, or both; or a sound file on a device. A "
     "contact is felt one constant output latency later, which is printed. Without --device and "
     "--board it lists the devices and a call to type. Ctrl-C silences the output at once and ends the "
     "program."},
    {"physvib-study", "Lists, shows and runs protocols of perception studies. In the mixer people answer; "
                      "here a simulated observer does, to rehearse a protocol and its analysis. An "
                      "interrupted run continues with the trial that was cut off."},
    {"physvib-analyse", "Analyses tables of trials: confusion matrices and information transfer, perceptual "
                        "resolution, choices, ratings, thresholds. Trials of a training are left out."},
    {"physvib-board", "Talks to the four-channel board over a serial port: its state, a self-test, and event "
                      "lists to play. The port is a path, or auto."},
});

std::string_view findDescription(std::string_view page) {
    const auto found = std::ranges::find(descriptions, page, &Description::page);
    return found == descriptions.end() ? std::string_view{} : found->text;
}

/// A manual page in roff, with the options of the command and its subcommands. `pages` are listed at the end.
std::string manPage(const OptionTable& command, const std::vector<std::string>& pages) {
    std::ostringstream out;
    out << ".TH " << manText(upperCase(pageName(command))) << " 1 \"\" \"PhysVib " << PHYSVIB_VERSION
        << "\" \"PhysVib\"\n.SH NAME\n"
        << manText(pageName(command)) << " \\- " << manText(command.meaning) << "\n.SH SYNOPSIS\n";
    writeCall(out, command);
    if (const auto text = findDescription(pageName(command)); !text.empty())
        out << ".SH DESCRIPTION\n" << manText(text) << '\n';
    if (std::ranges::any_of(command.options, [](const auto& option) { return !option.meaning.empty(); }))
        out << ".SH OPTIONS\n";
    writeOptions(out, command);
    writeCommands(out, command);
    out << ".SH EXIT STATUS\n0: done. 1: failed; one line says file, place and expectation. 2: a wrong "
           "call.\n.SH SEE ALSO\n";
    std::string others;
    for (const std::string& page : pages)
        if (page != pageName(command))
            others += (others.empty() ? "\\fB" : ", \\fB") + manText(page) + "\\fR(1)";
    out << others << (others.empty() ? "" : ".\n.br\n")
        << "The pages in \\fI/usr/share/doc/physvib/Docs\\fR.\n";
    return out.str();
}

// Completion scripts for bash, zsh and fish. Values without choices complete to file names. The bash and zsh
// scripts find the command among the words typed so far.

using CommandVisitor = std::function<void(const OptionTable&)>;

void forEachCommand(const OptionTable& command, const CommandVisitor& visit) {
    visit(command);
    for (const OptionTable& inner : command.commands) forEachCommand(inner, visit);
}

std::string inParentheses(const std::vector<std::string>& words) { return '(' + joinNames(words, " ") + ')'; }

std::vector<std::string> commandNames(const OptionTable& command) {
    std::vector<std::string> names;
    for (const OptionTable& inner : command.commands) names.push_back(inner.name());
    return names;
}

/// A function name without hyphens, which not all shells allow.
std::string functionName(const OptionTable& program) {
    std::string name(1, '_');
    for (const char c : program.words) name += c == '-' ? '_' : c;
    return name;
}

/// "physvib render"|"physvib play": a pattern of all calls of commands.
std::string allCalls(const OptionTable& program) {
    std::string calls;
    forEachCommand(program, [&](const OptionTable& command) {
        if (&command != &program) (calls += calls.empty() ? "" : "|") += shellWord(command.words);
    });
    return calls.empty() ? "''" : calls;
}

void writeHeading(std::ostream& out, const OptionTable& program) {
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
        (text += ": :") += option.choices.empty() ? "_files" : inParentheses(option.choices);
    return shellWord(text);
}

std::string zshArguments(const OptionTable& command) {
    if (!command.commands.empty())
        return shellWord(std::string{"*: :"}.append(inParentheses(commandNames(command))));
    for (const Option& option : command.options)
        if (option.isPositional && !option.choices.empty())
            return shellWord(std::string{"*: :{_alternative \"n: :"}.append(inParentheses(option.choices)) +
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
        (condition += "; and not __fish_seen_subcommand_from ") += joinNames(commandNames(command), " ");
    return std::string{" -n "}.append(shellWord(condition));
}

std::string fishOption(const Option& option) {
    std::string words;
    if (!option.isPositional)
        for (const std::string& name : option.spellings)
            words += name.starts_with("--") ? std::string{" -l "}.append(name, 2)
                                            : std::string{" -s "}.append(name, 1);
    if (!option.choices.empty())
        words += std::string{option.isPositional ? " -a " : " -x -a "}.append(
            shellWord(joinNames(option.choices, " ")));
    else if (!option.isPositional && !option.value().empty())
        words += " -r";
    if (!option.meaning.empty()) (words += " -d ") += shellWord(option.meaning);
    return words;
}

std::string bashCompletion(const OptionTable& program) {
    std::ostringstream out;
    writeHeading(out, program);
    out << functionName(program) << "() {\n    local word call=" << program.words << " choices=\n"
        << "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
        << "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case \"$call $word\" in "
        << allCalls(program) << ") call=\"$call $word\" ;; esac\n    done\n"
        << "    case \"$call $previous\" in\n";
    forEachCommand(program, [&](const OptionTable& command) {
        for (const Option& option : command.options)
            for (const std::string& name : option.spellings)
                if (!option.isPositional && !option.value().empty())
                    out << "        " << shellWord(command.words + ' ' + name) << ") "
                        << (option.choices.empty()
                                ? "return"
                                : std::string{"choices="}.append(shellWord(joinNames(option.choices, " "))))
                        << " ;;\n";
    });
    out << "    esac\n    [ -n \"$choices\" ] || case $call in\n";
    forEachCommand(program, [&](const OptionTable& command) {
        std::vector<std::string> words = commandNames(command);
        for (const Option& option : command.options) {
            const auto& proposals = option.isPositional ? option.choices : option.spellings;
            words.insert(words.end(), proposals.begin(), proposals.end());
        }
        out << "        " << shellWord(command.words) << ") choices=" << shellWord(joinNames(words, " "))
            << " ;;\n";
    });
    out << "    esac\n    COMPREPLY=($(compgen -W \"$choices\" -- \"$current\"))\n}\ncomplete -o default -F "
        << functionName(program) << ' ' << program.words << '\n';
    return out.str();
}

std::string zshCompletion(const OptionTable& program) {
    std::ostringstream out;
    out << "#compdef " << program.words << '\n';
    writeHeading(out, program);
    out << "local word call=" << program.words
        << "\nfor word in ${words[2,CURRENT-1]}; do\n    case \"$call $word\" in (" << allCalls(program)
        << ") call=\"$call $word\" ;; esac\ndone\ncase $call in\n";
    forEachCommand(program, [&](const OptionTable& command) {
        out << "    (" << shellWord(command.words) << ") _arguments";
        for (const Option& option : command.options)
            for (const std::string& name : option.spellings)
                if (!option.isPositional) out << " \\\n        " << zshOption(option, name);
        out << " \\\n        " << zshArguments(command) << " ;;\n";
    });
    out << "esac\n";
    return out.str();
}

// Fish has a condition for each proposal: those of a command apply after its words and before a subcommand.
std::string fishCompletion(const OptionTable& program) {
    std::ostringstream out;
    writeHeading(out, program);
    forEachCommand(program, [&](const OptionTable& command) {
        const std::string begin = "complete -c " + program.words + fishCondition(program, command);
        for (const OptionTable& inner : command.commands)
            out << begin << " -f -a " << inner.name() << " -d " << shellWord(inner.meaning) << '\n';
        for (const Option& option : command.options) out << begin << fishOption(option) << '\n';
    });
    return out.str();
}

} // namespace

std::string writeReference(const OptionTable& program, const std::filesystem::path& folder) {
    const std::string ownPage = pageName(program);
    std::vector<std::string> pages{ownPage};
    std::map<std::filesystem::path, std::string> files{
        {"md/" + program.words + ".md", markdownPage(program)},
        {"bash/" + program.words, bashCompletion(program)},
        {"zsh/_" + program.words, zshCompletion(program)},
        {"fish/" + program.words + ".fish", fishCompletion(program)}};
    for (const OptionTable& command : program.commands) {
        pages.push_back(pageName(command));
        files["man1/" + pages.back() + ".1"] = manPage(command, {ownPage});
    }
    files["man1/" + ownPage + ".1"] = manPage(program, pages);
    for (const auto& [name, text] : files) {
        std::error_code code;
        const auto folderPath = (folder / name).parent_path();
        std::filesystem::create_directories(folderPath, code);
        if (code) return folderPath.string() + ": cannot be made: " + code.message();
        if (auto error = writeFile(folder / name, text); !error.empty()) return error;
    }
    return {};
}

} // namespace physvib
