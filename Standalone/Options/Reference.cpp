// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the reference files of a program.
#include "Options/Reference.h"
#include "Io/Disk/AtomicFile.h"
#include "Options/Completions.h"
#include "Options/ManPage.h"
#include <algorithm>
#include <cctype>
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

std::string asCode(const std::string& text) { return text.empty() ? text : '`' + tableCell(text) + '`'; }

std::string spelt(const Option& option) {
    std::string out;
    for (const std::string& spelling : option.spellings) out += (out.empty() ? "" : ", ") + asCode(spelling);
    return out;
}

bool isListed(const Option& option) {
    return !option.meaning.empty() && std::ranges::find(option.spellings, "--help") == option.spellings.end();
}

void writeOptionTable(std::ostream& out, const OptionTable& command) {
    if (std::ranges::none_of(command.options, isListed)) return;
    out << "\n| option | value | default | meaning |\n| --- | --- | --- | --- |\n";
    for (const Option& option : command.options)
        if (isListed(option))
            out << "| " << spelt(option) << " | " << asCode(option.isPlace ? option.range : option.value())
                << " | " << asCode(option.initial) << " | " << tableCell(option.meaning)
                << (option.isRequired ? " (required) |\n" : " |\n");
}

void writeSection(std::ostream& out, const OptionTable& command, const std::string& heading) {
    std::string sentence = command.meaning + '.';
    sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
    out << '\n' << heading << " `" << command.words << "`\n" << sentence << '\n';
    writeOptionTable(out, command);
    for (const OptionTable& inner : command.commands) writeSection(out, inner, heading + '#');
}

/// Markdown with a table of options for each command of a program. Message thread.
std::string markdownPage(const OptionTable& program) {
    std::ostringstream out;
    out << "<!-- SPDX-License-Identifier: MIT -->\n<!-- Generated: " << program.words
        << " --reference FOLDER, and FOLDER/md/" << program.words << ".md -->\n# Commands and options\n\n"
        << "Every command of `" << program.words << "` with its options. `" << program.words
        << " COMMAND --help` and `man " << program.words
        << "-COMMAND` print the same. Options of ranges refuse other values.\n";
    writeOptionTable(out, program);
    for (const OptionTable& command : program.commands) writeSection(out, command, "##");
    return out.str();
}

std::string writeInto(const std::filesystem::path& folder, const std::string& name, const std::string& text) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    return error ? folder.string() + ": cannot be made: " + error.message() : writeFile(folder / name, text);
}

std::string writePages(const OptionTable& program, const std::filesystem::path& folder) {
    std::vector<std::string> pages{pageName(program)};
    for (const OptionTable& command : program.commands) pages.push_back(pageName(command));
    if (auto error = writeInto(folder, pages.front() + ".1", manPage(program, pages)); !error.empty())
        return error;
    for (const OptionTable& command : program.commands)
        if (auto error = writeInto(folder, pageName(command) + ".1", manPage(command, {pages.front()}));
            !error.empty())
            return error;
    return {};
}

} // namespace

std::string writeReference(const OptionTable& program, const std::filesystem::path& folder) {
    if (auto error = writePages(program, folder / "man1"); !error.empty()) return error;
    if (auto error = writeInto(folder / "md", program.words + ".md", markdownPage(program)); !error.empty())
        return error;
    if (auto error = writeInto(folder / "bash", program.words, bashCompletion(program)); !error.empty())
        return error;
    if (auto error = writeInto(folder / "zsh", "_" + program.words, zshCompletion(program)); !error.empty())
        return error;
    return writeInto(folder / "fish", program.words + ".fish", fishCompletion(program));
}

} // namespace physvib
