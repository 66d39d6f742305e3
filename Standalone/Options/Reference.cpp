// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the reference files of a program.
#include "Options/Reference.h"
#include "Io/Disk/AtomicFile.h"
#include "Options/Completions.h"
#include "Options/ManPage.h"
#include "Options/MarkdownPage.h"
#include <system_error>

namespace physvib {
namespace {

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
