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

int runReference(const OptionTable& program, const char* folder) {
    const std::string error = writeReference(program, folder);
    return error.empty() ? exitDone : reportExit(exitFailed, error);
}

/// If the call names a statistical test as an analysis: an error that says how it is run in R; else empty.
std::string movedAnalysisError(int argc, char** argv) {
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
    OptionTable program{"physvib", "PhysVib: physics collisions as vibration, on 1 to 64 actuators."};
    program.addVersion("physvib " PHYSVIB_VERSION);
    std::map<const OptionTable*, std::function<int()>> runFunctions;
    const bool writesReference = argc == 3 && std::string_view{argv[1]} == referenceWord;
    for (const auto factory : commands) {
        const Command command = factory();
        OptionTable& table = program.addCommand(command.name, command.description);
        // only the called command's options are declared: those of all take longer than many runs
        if (writesReference || std::find(argv, argv + argc, std::string_view{command.name}) != argv + argc)
            runFunctions[&table] = command.declare(table);
    }
    if (writesReference) return runReference(program, argv[2]);
    const ParseResult parsed = parseArguments(program, argc, argv);
    if (!parsed.help.empty()) {
        std::cout << parsed.help;
        return exitDone;
    }
    if (const std::string movedError = movedAnalysisError(argc, argv);
        !parsed.error.empty() && !movedError.empty())
        return reportExit(exitUsage, movedError);
    if (!parsed.error.empty()) return reportExit(exitUsage, parsed.reason() + " (see physvib --help)");
    if (const std::string clash = callFileClash(program); !clash.empty()) return reportExit(exitUsage, clash);
    return runFunctions.at(program.called())();
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
        reportExit(exitFailed, "memory: expected more of it");
    } catch (const std::exception& error) { // such as a full disk reported by a library
        reportExit(exitFailed, error.what());
    }
    const std::string error = outputError();
    if (!error.empty() && code == exitDone) code = reportExit(exitFailed, error);
    endNonBlockingOutput();
    if (DeviceThread::abandonedThreads() > 0) exitImmediately(code);
    return code;
}
