// SPDX-License-Identifier: GPL-3.0-or-later
// Main program of `physvib`: list of commands, and error messages for invalid calls.
#include "Calls/CallOptions.h"
#include "CommandLine/Command.h"
#include "Live/Devices/AudioDevice.h"
#include "Options/OptionTable.h"
#include "System/Process.h"
#include <algorithm>
#include <exception>
#include <iostream>
#include <map>
#include <new>

namespace physvib {

Command scenesCommand(), renderCommand(), exportCommand(), beatsCommand(), playCommand(), analyseCommand(),
    reportCommand(), stimulusCommand(), boardCommand(), studyCommand(), materialCommand(),
    attenuationCommand(), couplingCommand(), actuatorsCommand(), devicesCommand(), padsCommand(),
    calibrateCommand(), thesisCommand();

namespace {

/// In the order of --help; each is in its own file.
constexpr Command (*commands[])() = {
    scenesCommand,   renderCommand,    exportCommand,  beatsCommand, playCommand,      analyseCommand,
    reportCommand,   stimulusCommand,  boardCommand,   studyCommand, materialCommand,  attenuationCommand,
    couplingCommand, actuatorsCommand, devicesCommand, padsCommand,  calibrateCommand, thesisCommand};

int writeOwnReference(const OptionTable& app, const char* folder) {
    const std::string error = writeReference(app, folder);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

/// Where tests over participants are, for who calls them as analyses; empty for other calls.
std::string goneAnalysis(int argc, char** argv) {
    constexpr std::string_view tests[] = {"anova",          "friedman", "wilcoxon", "mann-whitney",
                                          "kruskal-wallis", "shapiro",  "pairs"};
    if (argc < 3 || std::string_view{argv[1]} != "analyse" ||
        std::ranges::find(tests, argv[2]) == std::end(tests))
        return {};
    return std::string{"analyse "} + argv[2] +
           ": tests are run in R: `physvib report TRIALS.csv... --out FOLDER`, then `Rscript "
           "FOLDER/analysis.R`";
}

int run(int argc, char** argv) {
    OptionTable app{"physvib", "PhysVib: physics collisions as vibration, on 1 to 64 actuators."};
    app.addVersion("physvib " PHYSVIB_VERSION);
    std::map<const OptionTable*, std::function<int()>> runs;
    const bool isReference = argc == 3 && std::string_view{argv[1]} == referenceWord;
    for (const auto make : commands) {
        const Command command = make();
        OptionTable& table = app.addCommand(command.name, command.meaning);
        // the options of the others would cost more than many a call
        if (isReference || std::find(argv, argv + argc, std::string_view{command.name}) != argv + argc)
            runs[&table] = command.declare(table);
    }
    if (isReference) return writeOwnReference(app, argv[2]);
    const ParsedWords parsed = parseArguments(app, argc, argv);
    if (!parsed.help.empty()) {
        std::cout << parsed.help;
        return exitDone;
    }
    if (const std::string gone = goneAnalysis(argc, argv); !parsed.fault.empty() && !gone.empty())
        return leave(exitUsage, gone);
    if (!parsed.fault.empty()) return leave(exitUsage, parsed.reason() + " (see physvib --help)");
    if (const std::string clash = clashOfCall(app); !clash.empty()) return leave(exitUsage, clash);
    return runs.at(app.called())();
}

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    using namespace physvib;
    beginProcess();
    int code = exitFailed;
    try {
        code = run(argc, argv);
    } catch (const std::bad_alloc&) {
        leave(exitFailed, "memory: expected more of it");
    } catch (const std::exception& error) { // such as a full disk reported by a library
        leave(exitFailed, error.what());
    }
    const std::string fault = outputFault();
    if (!fault.empty() && code == exitDone) code = leave(exitFailed, fault);
    endOutput();
    if (DeviceThread::threadsLeft() > 0) endAtOnce(code);
    return code;
}
