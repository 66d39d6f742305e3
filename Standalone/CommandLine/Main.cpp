// SPDX-License-Identifier: GPL-3.0-or-later
// The `physvib` program: its commands, and how a wrong call is told.
#include "CommandLine/Analyse/AnalyseCommand.h"
#include "CommandLine/Board/BoardCommand.h"
#include "CommandLine/ExitCode.h"
#include "CommandLine/Measure/AttenuationCommand.h"
#include "CommandLine/Measure/CalibrateCommand.h"
#include "CommandLine/Measure/CouplingCommand.h"
#include "CommandLine/Measure/MaterialCommand.h"
#include "CommandLine/Music/BeatsCommand.h"
#include "CommandLine/Play/PlayCommand.h"
#include "CommandLine/Process.h"
#include "CommandLine/Reference/Reference.h"
#include "CommandLine/Render/ActuatorChoice.h"
#include "CommandLine/Render/ExportCommand.h"
#include "CommandLine/Render/RenderCommand.h"
#include "CommandLine/Report/ReportCommand.h"
#include "CommandLine/StandardStreams.h"
#include "CommandLine/Study/CallFiles.h"
#include "CommandLine/Study/StimulusCommand.h"
#include "CommandLine/Study/StudyCommand.h"
#include "CommandLine/Sweep/SweepCommand.h"
#include "Files/SceneCatalogue.h"
#include "Host/Devices/DeviceThread.h"
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace physvib {
namespace {

int listScenes() {
    for (const Scene& scene : builtInScenes()) {
        std::cout << scene.name << "  " << scene.description;
        for (const SceneVariable& variable : scene.variables) {
            std::cout << "  --set " << variable.name << '=';
            for (const std::string& choice : variable.choices)
                std::cout << (&choice == &variable.choices.front() ? "" : "|") << choice;
        }
        std::cout << '\n';
    }
    return exitDone;
}

int writeOwnReference(const CLI::App& app, const char* folder) {
    const std::string error = writeReference(listedCommand(app, "physvib"), folder);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

int run(int argc, char** argv) {
    CLI::App app{"PhysVib: collisions one can feel, on every enchanter you attach."};
    app.set_version_flag("--version", "physvib " PHYSVIB_VERSION);
    app.require_subcommand(1);
    RenderOptions options;
    CLI::App* scenes = app.add_subcommand("scenes", "list the built-in scenes");
    CLI::App* render = app.add_subcommand("render", "render a scene, an event list or a clip to files");
    declareRenderOptions(*render, options);
    SweepOptions sweepOptions;
    CLI::App* sweep = app.add_subcommand(
        "sweep", "many renders of a design as a table of numbers, on all processors or a cluster");
    declareSweep(*sweep, sweepOptions);
    ExportOptions exportOptions;
    CLI::App* exported =
        app.add_subcommand("export", "a scene, a session, EVENTS.csv or a clip as a haptic file of others");
    declareExport(*exported, exportOptions);
    BeatsOptions beatsOptions;
    CLI::App* beats =
        app.add_subcommand("beats", "music as strikes on enchanters, or what of it they can render");
    declareBeats(*beats, beatsOptions);
    PlayOptions playOptions;
    CLI::App* play = app.add_subcommand("play", "play a scene live on an audio device");
    declarePlayOptions(*play, playOptions);
    AnalyseOptions analyseOptions;
    CLI::App* analyse = app.add_subcommand("analyse", "what the trials of a study say");
    declareAnalyse(*analyse, analyseOptions);
    ReportOptions reportOptions;
    CLI::App* report = app.add_subcommand("report", "trial files as a page with pictures, tests and tables");
    declareReport(*report, reportOptions);
    StimulusOptions stimulusOptions;
    CLI::App* stimulus = app.add_subcommand("stimulus", "a single stimulus of a study");
    declareStimulus(*stimulus, stimulusOptions);
    BoardOptions boardOptions;
    CLI::App* board = app.add_subcommand("board", "the four-channel board: info, play an event list, test");
    declareBoardOptions(*board, boardOptions);
    StudyOptions studyOptions;
    CLI::App* study = app.add_subcommand("study", "whole studies, from a protocol");
    declareStudy(*study, studyOptions);
    MaterialOptions materialOptions;
    CLI::App* material = app.add_subcommand("material", "frequency and decay of a recorded contact");
    declareMaterial(*material, materialOptions);
    AttenuationOptions attenuationOptions;
    CLI::App* attenuation = app.add_subcommand(
        "attenuation",
        "what an isolation layer holds back, from two recordings or a folder of conditions (thesis 3.1.1)");
    declareAttenuation(*attenuation, attenuationOptions);
    CouplingOptions couplingOptions;
    CLI::App* coupling = app.add_subcommand(
        "coupling", "what enchanters make of each other's vibration, from recordings, for render --coupling");
    declareCoupling(*coupling, couplingOptions);
    CLI::App* actuators =
        app.add_subcommand("actuators", "list the built-in actuator profiles; what is not known is empty");
    CLI::App* devices = app.add_subcommand("devices", "list the audio devices");
    CalibrateOptions calibrateOptions;
    CLI::App* calibrate = app.add_subcommand("calibrate", "measure an actuator and write its profile");
    declareCalibrate(*calibrate, calibrateOptions);
    if (argc == 3 && std::string_view{argv[1]} == referenceWord) return writeOwnReference(app, argv[2]);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
        const auto unknown = app.remaining();
        const std::string reason = unknown.empty() ? error.what() : "unknown: " + unknown.front();
        return leave(exitUsage, reason + " (see physvib --help)");
    }
    if (const std::string clash = clashOfCall(app); !clash.empty()) return leave(exitUsage, clash);
    if (scenes->parsed()) return listScenes();
    if (actuators->parsed()) return listActuators();
    if (devices->parsed()) return runDevices();
    if (analyse->parsed()) return runAnalyse(*analyse, analyseOptions);
    if (report->parsed()) return runReport(reportOptions);
    if (stimulus->parsed()) return runStimulus(*stimulus, stimulusOptions);
    if (study->parsed()) return runStudy(*study, studyOptions);
    if (material->parsed()) return runMaterial(materialOptions);
    if (beats->parsed()) return runBeats(beatsOptions);
    if (play->parsed()) return runPlay(playOptions);
    if (sweep->parsed()) return runSweep(sweepOptions);
    if (exported->parsed()) return runExport(*exported, exportOptions);
    if (board->parsed()) return runBoard(boardOptions);
    if (attenuation->parsed()) return runAttenuation(attenuationOptions);
    if (coupling->parsed()) return runCoupling(couplingOptions);
    if (calibrate->parsed()) return runCalibrate(calibrateOptions);
    noteGiven(*render, options);
    const std::string refusal = checkRenderOptions(options);
    return refusal.empty() ? runRender(options) : leave(exitUsage, refusal);
}

} // namespace
} // namespace physvib

int main(int argc, char** argv) {
    using namespace physvib;
    beginProcess();
    int code = exitFailed;
    try {
        code = run(argc, argv);
    } catch (const std::exception& error) { // out of memory, a full disk inside a library: still one line
        leave(exitFailed, error.what());
    }
    const std::string fault = outputFault();
    if (!fault.empty() && code == exitDone) code = leave(exitFailed, fault);
    endOutput();
    if (DeviceThread::threadsLeft() > 0) endAtOnce(code);
    return code;
}
