// SPDX-License-Identifier: GPL-3.0-or-later
// Collects the input and output files of parsed calls and of the option tables.
#include "Calls/CallFiles.h"
#include "Calls/RenderOptions.h"
#include "Calls/StimulusOptions.h"
#include "Io/Disk/FileClash.h"
#include "Lab/Files/ProtocolFile.h"
#include <set>
#include <vector>

namespace physvib {
namespace {

struct CallFiles {
    std::vector<std::string> outputs, inputs;
};

void collect(const OptionTable& table, CallFiles& files) {
    for (const Option& option : table.options)
        for (const std::string& value : option.said) {
            if (option.isWritten)
                files.outputs.push_back(value);
            else
                files.inputs.insert(files.inputs.end(),
                                    {value, value.substr(value.find('=') + 1)}); // of MATERIAL=FILE
        }
    for (const OptionTable* const command : table.calls) collect(*command, files);
}

void collectWritten(const OptionTable& table, std::set<std::string, std::less<>>& words) {
    for (const Option& option : table.options)
        if (option.isWritten) words.insert(option.spellings.begin(), option.spellings.end());
    for (const OptionTable& command : table.commands) collectWritten(command, words);
}

/// Every spelling of every output-file option of the commands that a call may use.
std::set<std::string, std::less<>> writtenWords() {
    OptionTable calls{"physvib", {}};
    RenderJob render;
    StimulusOptions stimulus;
    declareRenderOptions(calls.addCommand("render", {}), render);
    declareStimulus(calls.addCommand("stimulus", {}), stimulus);
    std::set<std::string, std::less<>> words;
    collectWritten(calls, words);
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

std::string linkOfCallFault(const OptionTable& app, const std::string& folder) {
    CallFiles files;
    collect(app, files);
    for (const std::string& path : files.inputs)
        if (auto fault = linkFault(folder, path); !fault.empty()) return fault;
    return {};
}

std::string clashOfCall(const OptionTable& app) {
    CallFiles files;
    collect(app, files);
    return fileClash(files.outputs, files.inputs);
}

} // namespace physvib
