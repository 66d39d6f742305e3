// SPDX-License-Identifier: GPL-3.0-or-later
// One page for all commands: a heading, the call, and a table of options each.
#include "Options/MarkdownPage.h"
#include <algorithm>
#include <sstream>

namespace physvib {
namespace {

/// A cell of a table: a bar would end it.
std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) out += c == '|' ? std::string{"\\|"} : c == '\n' ? std::string{" "} : std::string{c};
    return out;
}

std::string code(const std::string& text) { return text.empty() ? text : '`' + cell(text) + '`'; }

std::string spelt(const Option& option) {
    std::string out;
    for (const std::string& spelling : option.spellings) out += (out.empty() ? "" : ", ") + code(spelling);
    return out;
}

bool isShown(const Option& option) {
    return !option.meaning.empty() && std::ranges::find(option.spellings, "--help") == option.spellings.end();
}

void writeOptions(std::ostream& out, const OptionTable& command) {
    if (std::ranges::none_of(command.options, isShown)) return;
    out << "\n| option | value | default | meaning |\n| --- | --- | --- | --- |\n";
    for (const Option& option : command.options)
        if (isShown(option))
            out << "| " << spelt(option) << " | " << code(option.isPlace ? option.range : option.value()) << " | " << code(option.initial) << " | " << cell(option.meaning)
                << (option.isRequired ? " (required) |\n" : " |\n");
}

void writeCommand(std::ostream& out, const OptionTable& command, const std::string& heading) {
    out << '\n' << heading << " `" << command.words << "`\n" << command.meaning << ".\n";
    writeOptions(out, command);
    for (const OptionTable& inner : command.commands) writeCommand(out, inner, heading + '#');
}

} // namespace

std::string markdownPage(const OptionTable& program) {
    std::ostringstream out;
    out << "<!-- SPDX-License-Identifier: MIT -->\n<!-- Generated: " << program.words << " --reference FOLDER, and FOLDER/md/" << program.words << ".md -->\n# Commands and options\n\n"
        << "Every command of `" << program.words << "` with its options. `" << program.words << " COMMAND --help` and `man " << program.words << "-COMMAND` print the same. Options of ranges refuse other values.\n";
    writeOptions(out, program);
    for (const OptionTable& command : program.commands) writeCommand(out, command, "##");
    return out.str();
}

} // namespace physvib
