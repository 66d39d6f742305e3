// SPDX-License-Identifier: GPL-3.0-or-later
// A manual page: name, call, options, commands, exit codes.
#include "Options/ManPage.h"
#include <algorithm>
#include <sstream>

namespace physvib {
namespace {

/// As man shows it: a hyphen is one that can be copied, and no line is taken for a request.
std::string shown(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '\\') out += "\\e";
        else if (c == '-') out += "\\-";
        else if ((c == '.' || c == '\'') && (out.empty() || out.back() == '\n')) (out += "\\&") += c;
        else out += c;
    }
    return out;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? std::string{} : std::string{between}) + word;
    return out;
}

std::string capitals(std::string text) {
    std::ranges::transform(text, text.begin(), [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; });
    return text;
}

void writeOption(std::ostream& out, const Option& option) {
    const std::string name = shown(joined(option.spellings, ", "));
    out << ".TP\n" << (option.isPlace ? "\\fI" : "\\fB") << name << "\\fR";
    if (!option.value().empty() && !option.isPlace) out << " \\fI" << shown(option.value()) << "\\fR";
    if (!option.initial.empty()) out << " (" << shown(option.initial) << ')';
    out << '\n' << shown(option.meaning) << '\n';
}

void writeInCall(std::ostream& out, const Option& option) {
    const std::string name = shown(option.spellings.back());
    out << (option.isRequired ? " " : " [") << (option.isPlace ? "\\fI" + name : "\\fB" + name + "\\fR \\fI" + shown(option.value())) << (option.isRequired ? "\\fR" : "\\fR]");
}

void writeCall(std::ostream& out, const OptionTable& command) {
    if (!command.usage.empty()) {
        out << ".nf\n" << shown(command.usage) << ".fi\n";
        return;
    }
    out << "\\fB" << shown(command.words) << "\\fR [\\fIoptions\\fR]";
    for (const Option& option : command.options)
        if (option.isPlace || option.isRequired) writeInCall(out, option);
    out << (command.commands.empty() ? "\n" : " \\fIcommand\\fR ...\n");
}

void writeOptions(std::ostream& out, const OptionTable& command) {
    for (const Option& option : command.options)
        if (!option.meaning.empty()) writeOption(out, option);
}

/// A program's commands have pages of their own; those of a command are on its page.
void writeCommands(std::ostream& out, const OptionTable& command) {
    if (command.commands.empty()) return;
    const bool isProgram = command.words.find(' ') == std::string::npos;
    out << ".SH COMMANDS\n";
    for (const OptionTable& inner : command.commands) {
        if (isProgram) {
            out << ".TP\n\\fB" << shown(pageName(inner)) << "\\fR(1)\n" << shown(inner.meaning) << '\n';
            continue;
        }
        out << ".SS " << shown(inner.words) << '\n' << shown(inner.meaning) << "\n.PP\n";
        writeCall(out, inner);
        writeOptions(out, inner);
    }
}

} // namespace

std::string pageName(const OptionTable& command) {
    std::string name = command.words;
    std::ranges::replace(name, ' ', '-');
    return name;
}

std::string manPage(const OptionTable& command, const std::vector<std::string>& pages) {
    std::ostringstream out;
    out << ".TH " << shown(capitals(pageName(command))) << " 1 \"\" \"PhysVib " << PHYSVIB_VERSION << "\" \"PhysVib\"\n.SH NAME\n"
        << shown(pageName(command)) << " \\- " << shown(command.meaning) << "\n.SH SYNOPSIS\n";
    writeCall(out, command);
    if (std::ranges::any_of(command.options, [](const auto& option) { return !option.meaning.empty(); })) out << ".SH OPTIONS\n";
    writeOptions(out, command);
    writeCommands(out, command);
    out << ".SH EXIT STATUS\n0: done. 1: failed; one line says file, place and expectation. 2: a wrong call.\n.SH SEE ALSO\n";
    std::string others;
    for (const std::string& page : pages)
        if (page != pageName(command)) others += (others.empty() ? "\\fB" : ", \\fB") + shown(page) + "\\fR(1)";
    out << others << (others.empty() ? "" : ".\n.br\n") << "The pages in \\fI/usr/share/doc/physvib/Docs\\fR.\n";
    return out.str();
}

} // namespace physvib
