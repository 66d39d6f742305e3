// SPDX-License-Identifier: GPL-3.0-or-later
// Walks what was parsed.
#include "CommandLine/Study/CallFiles.h"
#include "Files/Disk/FileClash.h"
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
            if (isWritten(*option)) files.outputs.push_back(value);
            else files.inputs.insert(files.inputs.end(), {value, value.substr(value.find('=') + 1)}); // the latter for HZ=FILE.wav
        }
    for (CLI::App* const command : app.get_subcommands()) collect(*command, files);
}

} // namespace

std::string clashOfCall(CLI::App& app) {
    CallFiles files;
    collect(app, files);
    return fileClash(files.outputs, files.inputs);
}

} // namespace physvib
