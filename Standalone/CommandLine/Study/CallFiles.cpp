// SPDX-License-Identifier: GPL-3.0-or-later
// Walks what was parsed, and what can be.
#include "CommandLine/Study/CallFiles.h"
#include "CommandLine/Render/RenderOptions.h"
#include "CommandLine/Study/StimulusOptions.h"
#include "Files/Disk/FileClash.h"
#include "Files/ProtocolFile.h"
#include <set>
#include <vector>

namespace physvib {
namespace {

struct CallFiles {
    std::vector<std::string> outputs, inputs;
};

bool isWritten(CLI::Option& option) {
    try {
        return option.get_validator(writtenFile.get_name()) != nullptr;
    } catch (const CLI::OptionNotFound&) {
        return false;
    }
}

void collect(CLI::App& app, CallFiles& files) {
    for (CLI::Option* const option : app.get_options())
        for (const std::string& value : option->results()) {
            if (isWritten(*option))
                files.outputs.push_back(value);
            else
                files.inputs.insert(files.inputs.end(),
                                    {value, value.substr(value.find('=') + 1)}); // the latter for HZ=FILE.wav
        }
    for (CLI::App* const command : app.get_subcommands()) collect(*command, files);
}

void collectWritten(CLI::App& app, std::set<std::string, std::less<>>& words) {
    for (CLI::Option* const option : app.get_options()) {
        if (!isWritten(*option)) continue;
        for (const std::string& name : option->get_snames()) words.insert("-" + name);
        for (const std::string& name : option->get_lnames()) words.insert("--" + name);
    }
    for (CLI::App* const command : app.get_subcommands({})) collectWritten(*command, words);
}

/// Every spelling of every option that names a file to be written, of the commands that a call can be.
std::set<std::string, std::less<>> writtenWords() {
    CLI::App app;
    RenderOptions render;
    StimulusOptions stimulus;
    declareRenderOptions(*app.add_subcommand("render"), render);
    declareStimulus(*app.add_subcommand("stimulus"), stimulus);
    std::set<std::string, std::less<>> words;
    collectWritten(app, words);
    return words;
}

} // namespace

std::string writtenWordFault(std::string_view call) {
    static const auto words = writtenWords();
    while (!call.empty()) {
        const std::string_view word = call.substr(0, call.find(' '));
        call.remove_prefix(std::min(word.size() + 1, call.size()));
        if (words.contains(word.substr(0, word.find('='))))
            return "expected no file to be written, found " + std::string(word);
    }
    return {};
}

std::string linkOfCallFault(CLI::App& app, const std::string& folder) {
    CallFiles files;
    collect(app, files);
    for (const std::string& path : files.inputs)
        if (auto fault = linkFault(folder, path); !fault.empty()) return fault;
    return {};
}

std::string clashOfCall(CLI::App& app) {
    CallFiles files;
    collect(app, files);
    return fileClash(files.outputs, files.inputs);
}

} // namespace physvib
