// SPDX-License-Identifier: GPL-3.0-or-later
// The command `physvib study`: runs studies with simulated observers or in the mixer, and checks them.
#include "Calls/CallOptions.h"
#include "Calls/RenderJob.h"
#include "CommandLine/Command.h"
#include "CommandLine/Study/StudyOutput.h"
#include "Io/Disk/ContentHash.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/StudyReport.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/StudyRun.h"
#include "Live/Recordings/LoadRecordings.h"
#include "Studies/StudyCalls.h"
#include "Studies/StudyCheck.h"
#include "System/Process.h"
#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

namespace physvib {
namespace {

struct StudyOptions {
    std::string protocol;    ///< name of a built-in protocol, or path of a protocol file
    std::string observer;    ///< name of the simulated observer
    std::string participant; ///< code; empty: P and the number
    int number = 1;          ///< of the first participant: selects the row of the Latin squares
    int participants = 1;
    std::string folder = ".";
    RecordedSounds sounds;           ///< replace the protocol's recordings of that frequency
    std::vector<std::string> trials; ///< levels: trial files of the adjustments
    std::string levelsPath;          ///< levels: output file
    std::string pagePath;            ///< check: HTML output; empty: none
    std::string planPath;            ///< plan: output file; empty: none
    bool acceptsDeviations = false;  ///< check: limiter and guard may change what is published
    double paceSeconds = 0.0;        ///< delay per trial, to watch or interrupt it
};

int listProtocols() {
    for (const Protocol& protocol : knownProtocols())
        std::cout << protocol.name << "  " << protocol.title << '\n';
    return exitDone;
}

std::string participantCode(const StudyOptions& o, int number) {
    if (!o.participant.empty()) return o.participant;
    const std::string digits = std::to_string(number);
    return std::string("P").append(digits.size() < 2 ? "0" : "").append(digits);
}

void showProgress(const Participant& participant, int trials) {
    static const bool isTerminal = isErrorTerminal();
    if (isTerminal && trials % 50 == 0)
        std::cerr << '\r' << participant.code << " trial " << trials << "   \r";
}

/// Runs one participant from the first unanswered trial to the end. Returns an error or an empty string.
std::string runParticipant(const StudyRun& run, const ObserverSettings& settings, double paceSeconds) {
    if (auto error = studyRunError(run); !error.empty()) return error;
    StudyInProgress study{run};
    if (!study.error().empty()) return study.error();
    const Experiment& experiment = study.experiment();
    const SimulatedObserver observer{settings, run.protocol, run.participant};
    while (!experiment.isDone()) {
        if (paceSeconds > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(paceSeconds));
        if (!study.acceptAnswer(observer.answer(experiment))) return study.error();
        showProgress(run.participant, experiment.answeredTrials());
    }
    const int resumedTrials = study.resumedTrials();
    std::cout << study.path().string() << "  " << experiment.answeredTrials() << " trials"
              << (resumedTrials > 0 ? ", " + std::to_string(resumedTrials) + " of them there before"
                                    : std::string{})
              << '\n';
    return {};
}

/// Applies the recordings of the call to the protocol. One error line if a recording is invalid.
std::string applyRecordings(const RecordedSounds& sounds, Protocol& protocol) {
    for (const RecordedSound& source : sounds) {
        if (!source.material.empty())
            return "--sound: expected HZ=FILE.wav, the frequency of a study's stimuli, found " +
                   inQuotes(source.material);
        std::erase_if(protocol.sounds,
                      [&](const StudySoundFile& sound) { return sound.frequencyHz == source.frequencyHz; });
        protocol.sounds.push_back({source.frequencyHz, source.path});
    }
    for (const StudySoundFile& sound : protocol.sounds)
        if (auto contact = loadContact({sound.frequencyHz, resolveProtocolPath(protocol.folder, sound.file)});
            !contact)
            return contact.error;
        else if (!contact.value.note.empty())
            printMessage(contact.value.note);
    return {};
}

Result<Protocol> protocolWithSounds(const StudyOptions& o) {
    auto protocol = loadCheckedProtocol(o.protocol);
    if (!protocol) return protocol;
    if (auto error = applyRecordings(o.sounds, protocol.value); !error.empty()) return Failure{error};
    if (auto error = protocolError(protocol.value, o.protocol); !error.empty()) return Failure{error};
    return protocol;
}

/// Opens the mixer, in which a person answers, with the options of this call.
int runForPerson(const StudyOptions& o) {
    if (o.participants > 1)
        return reportExit(exitUsage,
                          "study run: --participants: expected one at a time where a person answers");
    if (!o.sounds.empty())
        return reportExit(exitUsage, "study run: --sound: expected sounds in the protocol where a person "
                                     "answers, as physvib-mixer reads no others");
    if (!hasDisplay())
        return reportExit(exitUsage,
                          "study run: expected --observer, or a display where physvib-mixer shows a "
                          "person what to answer; its tab Studies has the protocol " +
                              inQuotes(o.protocol));
    std::vector<std::string> arguments{"--study",       o.protocol,
                                       "--participant", participantCode(o, o.number),
                                       "--number",      std::to_string(o.number)};
    if (!o.folder.empty()) arguments.insert(arguments.end(), {"--out", o.folder});
    printMessage(
        "opening physvib-mixer, where a person answers; --observer simulated is answered by the computer");
    const auto success = runProgram(siblingProgram("physvib-mixer"), std::move(arguments));
    if (!success)
        return reportExit(exitFailed, success.error + "; expected the package of the mixer to be installed");
    return success.value ? exitDone : exitFailed;
}

int runStudies(const StudyOptions& o) {
    const std::string expected = "study run: --observer: expected " + std::string(observerNames);
    const bool isPersonAnswering = o.observer.empty() || o.observer == "person";
    const auto settings = isPersonAnswering ? std::optional<ObserverSettings>{} : observerNamed(o.observer);
    if (!isPersonAnswering && !settings)
        return reportExit(exitUsage, expected + ", found " + inQuotes(o.observer));
    if (!isParticipantCode(o.participant))
        return reportExit(exitUsage,
                          "study run: --participant: expected at most 32 letters, digits, - and _, found " +
                              inQuotes(o.participant));
    if (isPersonAnswering) return runForPerson(o);
    if (!o.participant.empty() && o.participants > 1)
        return reportExit(exitUsage,
                          "study run: --participant: expected one participant with a code, found several");
    const auto protocol = protocolWithSounds(o);
    if (!protocol) return reportExit(exitFailed, protocol.error);
    if (auto error = findStudyError(protocol.value); !error.empty())
        return reportExit(exitFailed, o.protocol + ": " + error);
    std::error_code folderError;
    std::filesystem::create_directories(o.folder, folderError);
    if (folderError) return reportExit(exitFailed, o.folder + ": cannot be made: " + folderError.message());
    for (int number = o.number; number < o.number + o.participants; ++number) {
        const StudyRun studyRun{protocol.value, {participantCode(o, number), number, o.observer}, o.folder};
        if (auto error = runParticipant(studyRun, *settings, o.paceSeconds); !error.empty())
            return reportExit(exitFailed, error);
    }
    printIfSimulated(true);
    return exitDone;
}

/// Whether limiter or guard change a study as published.
bool isChangedAsPublished(const Protocol& protocol) {
    return protocol.name.ends_with(thesisSuffix) &&
           std::ranges::any_of(findDeviations(protocol), [](const ThesisDeviation& deviation) {
               return deviation.property == HitProperty::limiter || deviation.property == HitProperty::guard;
           });
}

int checkProtocol(const StudyOptions& o) {
    const auto protocol = protocolWithSounds(o);
    if (!protocol) return reportExit(exitFailed, protocol.error);
    const StudyCheck result = checkStudy(protocol.value, o.participants);
    if (const int code =
            writeStudyFiles({StudyFile{o.pagePath, [&] { return toHtml(result, protocol.value); }}});
        code != exitDone)
        return code;
    std::cout << toText(result, protocol.value);
    if (!o.acceptsDeviations && isChangedAsPublished(protocol.value))
        return reportExit(exitFailed,
                          "study check: limiter or guard change what is published, as deviations above "
                          "say: expected --accept-deviations");
    return result.errors.empty() ? exitDone : exitFailed;
}

int planStudy(const StudyOptions& o) {
    const auto protocol = loadCheckedProtocol(o.protocol);
    if (!protocol) return reportExit(exitFailed, protocol.error);
    if (auto error = findStudyError(protocol.value); !error.empty())
        return reportExit(exitFailed, o.protocol + ": " + error);
    const auto planned = plannedStudy(protocol.value, o.participants, runAnalysisScript);
    if (!planned) return reportExit(exitFailed, planned.error);
    const auto script = std::filesystem::path{o.planPath}.replace_filename(analysisScriptName);
    const bool hasScript = !o.planPath.empty() && !planned.value.script.empty();
    if (const std::string error = hasScript ? scriptOverwriteError(script) : ""; !error.empty())
        return reportExit(exitFailed, error);
    if (const int code = writeStudyFiles({StudyFile{o.planPath, planned.value.text},
                                          StudyFile{hasScript ? script.string() : "", planned.value.script}});
        code != exitDone)
        return code;
    std::cout << planned.value.text;
    if (!o.planPath.empty()) // as the report prints it
        std::cout << '\n' << o.planPath << "  hash " << contentHash(planned.value.text) << '\n';
    return exitDone;
}

int averageAdjustments(const StudyOptions& o) {
    const auto protocol = loadCheckedProtocol(o.protocol);
    if (!protocol) return reportExit(exitFailed, protocol.error);
    std::vector<SessionPlan> sessions = protocol.value.sessions;
    std::erase_if(sessions, [](const SessionPlan& s) { return !s.adjustment; });
    if (std::ranges::any_of(sessions, std::logical_not{}, &SessionPlan::isTraining)) // as readLevels() does
        std::erase_if(sessions, [](const SessionPlan& s) { return s.isTraining; });
    if (sessions.size() != 1) // because a stimulus has one level in the file
        return reportExit(exitFailed, o.protocol + ": expected one session of the task adjust, found " +
                                          std::to_string(sessions.size()));
    const auto data = readStudyFiles(
        StudySources{o.trials}, [&](const std::vector<NamedText>& files) -> Result<StudyData<LevelTrial>> {
            for (const NamedText& file : files)
                if (TrialHead head = parseTrialHead(readCsvTable(file.text, file.name).value.comments);
                    !head.empty() && head["protocol"] != protocol.value.name)
                    return Failure{std::string{file.name} + ":1: expected trials of the protocol " +
                                   inQuotes(protocol.value.name) + ", found " + inQuotes(head["protocol"])};
            return readLevels(files);
        });
    if (!data) return reportExit(exitFailed, data.error);
    const auto averages =
        averageLevels(data.value.groups.front().trials, sessions[0].adjustment->alternative);
    if (averages.empty())
        return reportExit(exitFailed, o.trials.front() + ": expected adjustments, found none");
    Provenance provenance{PHYSVIB_VERSION,
                          {{"protocol", protocol.value.name}, {"hash", protocolHash(protocol.value)}}};
    if (data.value.isSimulated) provenance.entries.emplace_back("observer", "simulated");
    if (const int code = writeStudyFiles({StudyFile{o.levelsPath, stimulusLevelsCsv(averages, provenance)}});
        code != exitDone)
        return code;
    std::cout << o.levelsPath << "  " << averages.size() << " levels of "
              << plural(averages.front().participants, "participant") << '\n';
    printIfSimulated(data.value.isSimulated);
    return exitDone;
}

void declareStudy(OptionTable& command, StudyOptions& o) {
    command.addCommand("list", "the built-in protocols, one per line");
    command.addCommand("schema", "the JSON schema of protocols, for editors that check while one writes");
    OptionTable& show = command.addCommand("show", "a protocol as JSON, to start your own from");
    OptionTable& run = command.addCommand("run", "runs a study, or goes on with it where it was cut off");
    OptionTable& check =
        command.addCommand("check", "how strong each stimulus is, what the limiter would alter, how long it "
                                    "takes, how orders balance; nobody feels anything");
    OptionTable& levels = command.addCommand(
        "levels", "averages what experts set in a protocol's adjustments, for the levels_file of another");
    levels.add("--out", o.levelsPath, "a level per stimulus").outputFile("FILE.csv").required();
    OptionTable& plan = command.addCommand(
        "plan", "design, number of participants, stop rules, exclusions, tests and corrections, as text to "
                "register before the study; nobody feels anything");
    plan.add("--participants", o.participants, "how many are to take part").in(1, 1000).required();
    plan.add("--out", o.planPath, "the same text, for report --plan; beside it analysis.R, the tests in R")
        .outputFile("PLAN.txt");
    for (OptionTable* const subcommand : {&show, &run, &check, &levels, &plan})
        subcommand->add("protocol", o.protocol, "a built-in protocol or PROTOCOL.json").required();
    levels.add("trials", o.trials, "trial files of that protocol").as("TRIALS.csv").required();
    run.add("--observer", o.observer, "who answers: " + std::string(observerNames));
    run.add("--participant", o.participant, "code of the participant; no other personal data is kept")
        .as("CODE");
    run.add("--number", o.number, "number of the (first) participant: decides orders").in(1, 100000);
    run.add("--participants", o.participants, "how many, one after the other").in(1, 1000);
    check.add("--page", o.pagePath, "the check as a page of HTML").outputFile("FILE.html");
    check.add("--participants", o.participants, "whose orders are looked at").in(1, 1000);
    check.add("--accept-deviations", o.acceptsDeviations, "limiter and guard may change what is published");
    for (OptionTable* const subcommand : {&run, &check})
        addSounds(*subcommand, o.sounds,
                  "for a protocol that calls render --method SV: the recorded contact of the material of "
                  "that frequency; may be repeated")
            .as("HZ=FILE.wav");
    run.add("--out", o.folder, "folder of the trial files, NAME-CODE.csv").as("FOLDER");
    run.add("--pace", o.paceSeconds, "seconds per trial of a simulated observer").in(0.0, 60.0);
}

int runStudy(const OptionTable& command, const StudyOptions& o) {
    if (command.isCalled("list")) return listProtocols();
    if (command.isCalled("schema")) return std::cout << protocolSchema(), exitDone;
    if (command.isCalled("run")) return runStudies(o);
    if (command.isCalled("check")) return checkProtocol(o);
    if (command.isCalled("levels")) return averageAdjustments(o);
    if (command.isCalled("plan")) return planStudy(o);
    const auto protocol = loadCheckedProtocol(o.protocol);
    if (!protocol) return reportExit(exitFailed, protocol.error);
    std::cout << protocolJson(protocol.value);
    return exitDone;
}

} // namespace

Command studyCommand() {
    return makeCommand("study", "whole studies, from a protocol", declareStudy, runStudy);
}

} // namespace physvib
