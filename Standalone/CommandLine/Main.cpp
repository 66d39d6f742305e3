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
#include "Options/Parser.h"
#include "Options/Reference.h"
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

int writeOwnReference(const OptionTable& app, const char* folder) {
    const std::string error = writeReference(app, folder);
    return error.empty() ? exitDone : leave(exitFailed, error);
}

int run(int argc, char** argv) {
    OptionTable app{"physvib", "PhysVib: collisions one can feel, on every enchanter you attach."};
    app.addVersion("physvib " PHYSVIB_VERSION);
    RenderOptions options;
    app.addCommand("scenes", "list the built-in scenes");
    OptionTable& render = app.addCommand("render", "render a scene, an event list or a clip to files");
    declareRenderOptions(render, options);
    SweepOptions sweepOptions;
    OptionTable& sweep = app.addCommand(
        "sweep", "many renders of a design as a table of numbers, on all processors or a cluster");
    declareSweep(sweep, sweepOptions);
    ExportOptions exportOptions;
    OptionTable& exported =         app.addCommand("export", "a scene, a session, EVENTS.csv or a clip as a haptic file of others");
    declareExport(exported, exportOptions);
    BeatsOptions beatsOptions;
    OptionTable& beats =         app.addCommand("beats", "music as strikes on enchanters, or what of it they can render");
    declareBeats(beats, beatsOptions);
    PlayOptions playOptions;
    OptionTable& play = app.addCommand("play", "play a scene live on an audio device");
    declarePlayOptions(play, playOptions);
    AnalyseOptions analyseOptions;
    OptionTable& analyse = app.addCommand("analyse", "what the trials of a study say");
    declareAnalyse(analyse, analyseOptions);
    ReportOptions reportOptions;
    OptionTable& report = app.addCommand("report", "trial files as a page with pictures, tests and tables");
    declareReport(report, reportOptions);
    StimulusOptions stimulusOptions;
    OptionTable& stimulus = app.addCommand("stimulus", "a single stimulus of a study");
    declareStimulus(stimulus, stimulusOptions);
    BoardOptions boardOptions;
    OptionTable& board = app.addCommand("board", "the four-channel board: info, play an event list, test");
    declareBoardOptions(board, boardOptions);
    StudyOptions studyOptions;
    OptionTable& study = app.addCommand("study", "whole studies, from a protocol");
    declareStudy(study, studyOptions);
    MaterialOptions materialOptions;
    OptionTable& material = app.addCommand("material", "frequency and decay of a recorded contact");
    declareMaterial(material, materialOptions);
    AttenuationOptions attenuationOptions;
    OptionTable& attenuation = app.addCommand(
        "attenuation",
        "what an isolation layer holds back, from two recordings or a folder of conditions (thesis 3.1.1)");
    declareAttenuation(attenuation, attenuationOptions);
    CouplingOptions couplingOptions;
    OptionTable& coupling = app.addCommand(
        "coupling", "what enchanters make of each other's vibration, from recordings, for render --coupling");
    declareCoupling(coupling, couplingOptions);
    app.addCommand("actuators", "list the built-in actuator profiles; what is not known is empty");
    app.addCommand("devices", "list the audio devices");
    CalibrateOptions calibrateOptions;
    OptionTable& calibrate = app.addCommand("calibrate", "measure an actuator and write its profile");
    declareCalibrate(calibrate, calibrateOptions);
    if (argc == 3 && std::string_view{argv[1]} == referenceWord) return writeOwnReference(app, argv[2]);
    const ParsedWords parsed = parseArguments(app, argc, argv);
    if (!parsed.help.empty()) {
        std::cout << parsed.help;
        return exitDone;
    }
    if (!parsed.fault.empty()) return leave(exitUsage, parsed.reason() + " (see physvib --help)");
    if (const std::string clash = clashOfCall(app); !clash.empty()) return leave(exitUsage, clash);
    if (app.isCalled("scenes")) return listScenes();
    if (app.isCalled("actuators")) return listActuators();
    if (app.isCalled("devices")) return runDevices();
    if (app.isCalled("analyse")) return runAnalyse(analyse, analyseOptions);
    if (app.isCalled("report")) return runReport(reportOptions);
    if (app.isCalled("stimulus")) return runStimulus(stimulus, stimulusOptions);
    if (app.isCalled("study")) return runStudy(study, studyOptions);
    if (app.isCalled("material")) return runMaterial(materialOptions);
    if (app.isCalled("beats")) return runBeats(beatsOptions);
    if (app.isCalled("play")) return runPlay(playOptions);
    if (app.isCalled("sweep")) return runSweep(sweepOptions);
    if (app.isCalled("export")) return runExport(exported, exportOptions);
    if (app.isCalled("board")) return runBoard(boardOptions);
    if (app.isCalled("attenuation")) return runAttenuation(attenuationOptions);
    if (app.isCalled("coupling")) return runCoupling(couplingOptions);
    if (app.isCalled("calibrate")) return runCalibrate(calibrateOptions);
    noteGiven(render, options);
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
