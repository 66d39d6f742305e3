// SPDX-License-Identifier: MIT
// Plans by simulation: the tests of a plan are written by what will run them.
#include "Lab/Report/StudyPlanned.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Provenance.h"
#include "Io/Text/CsvText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Report/StudyReport.h"
#include "Lab/Study/SimulatedObserver.h"
#include <algorithm>
#include <set>

namespace physvib {
namespace {

constexpr int mostSimulated = 6; // as many as tests need; more change no test's call
constexpr std::string_view testMark = "- test: ", oldTestMark = "- physvib analyse ";

std::string codeOf(int number) { return std::string("P").append(std::to_string(number)); }

std::string simulatedFile(const Protocol& protocol, int number) {
    const Participant participant{codeOf(number), number, "simulated"};
    Experiment experiment{protocol, participant};
    const SimulatedObserver observer{ObserverSettings{}, protocol, participant};
    std::string text = trialHeader(protocol, participant, PHYSVIB_VERSION);
    while (!experiment.isDone())
        text += trialRow(protocol, participant, experiment.take(observer.answer(experiment)));
    return text;
}

Result<StudyReport> rehearsed(const Protocol& protocol, int participants) {
    std::vector<std::pair<std::string, std::string>> files;
    for (int number = 1; number <= std::min(participants, mostSimulated); ++number)
        files.emplace_back(codeOf(number), simulatedFile(protocol, number));
    const auto trials = readReportTrials(files, {}, protocol);
    if (!trials) return Failure{trials.error};
    return studyReport(trials.value);
}

std::string listOf(const char* title, const std::vector<std::string>& lines) {
    std::string text = "\n";
    text.append(title).append("\n");
    for (const std::string& line : lines) text.append("- ").append(line).append("\n");
    return text;
}

} // namespace

Result<PlannedStudy> plannedStudy(const Protocol& protocol, int participants) {
    auto report = rehearsed(protocol, participants);
    if (!report) return Failure{report.error};
    std::vector<std::string> conditions, sessions, tests;
    for (const std::string& test : report.value.tests) tests.push_back("test: " + test);
    for (const ConditionPlan& condition : protocol.conditions)
        conditions.push_back(conditionWords(condition));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionWords(session, protocol));
    std::string text = provenanceComment({PHYSVIB_VERSION,
                                          {{"plan", "study"},
                                           {"protocol", protocol.name},
                                           {"hash", protocolHash(protocol)},
                                           {"participants", std::to_string(participants)}}});
    text += listOf("Design", protocolSentences(protocol));
    text += listOf("Conditions", conditions) + listOf("Sessions, with their ends", sessions);
    text += listOf("Participants", {counted(static_cast<std::size_t>(participants), "participant") +
                                    ", numbers from 1, each once; nobody more or fewer, whatever is found"});
    text += listOf(
        "Exclusions",
        {"those who are excluded have a reason in the table of people, and all their trials are left out",
         "tests leave out who lacks a combination of levels; who did not finish is named"});
    text += listOf("Tests over participants, with their corrections, as analysis.R runs them in R", tests);
    if (tests.empty()) text += "none\n";
    return PlannedStudy{std::move(text), std::move(report.value.files[analysisScriptName])};
}

Result<std::vector<std::string>> comparedWithPlan(std::string_view plan, std::string_view name,
                                                  const ReportTrials& trials,
                                                  const std::vector<std::string>& tests) {
    std::string_view rest = plan, first = takeUntil('\n', rest);
    const TrialHead head = trialHeadOf({std::string{first.substr(std::min<std::size_t>(1, first.size()))}});
    if (!head.contains("plan") || !head.contains("hash") || !head.contains("participants"))
        return Failure{std::string{name} + ":1: expected a plan of `physvib study plan`"};
    std::set<std::string> planned;
    bool isOld = false; // its tests are calls of an analysis that is gone
    while (!rest.empty()) {
        const std::string_view line = takeUntil('\n', rest);
        if (line.starts_with(testMark)) planned.emplace(line.substr(testMark.size()));
        isOld |= line.starts_with(oldTestMark);
    }
    std::vector<std::string> sentences{"The plan has the hash " + contentHash(std::string{plan}) + "."};
    if (head.at("hash") != trials.common("hash"))
        sentences.push_back("The protocol is not the planned one: hash " + trials.common("hash") +
                            " instead of " + head.at("hash") + ".");
    std::set<std::string> people;
    for (const TrialFile& file : trials.files)
        if (const auto column = file.table.column("participant"))
            for (const CsvRow& row : file.table.rows) people.insert(row.cells[*column]);
    if (std::to_string(people.size()) != head.at("participants"))
        sentences.push_back("Planned were " + head.at("participants") + " participants, " +
                            std::to_string(people.size()) + " took part.");
    if (isOld) {
        sentences.emplace_back(
            "The plan lists its tests as calls of an earlier version: compare them with those here.");
        return sentences;
    }
    for (const std::string& test : tests)
        if (!planned.contains(test)) sentences.push_back("Not planned: " + test);
    for (const std::string& test : planned)
        if (std::ranges::find(tests, test) == tests.end()) sentences.push_back("Planned, not done: " + test);
    if (sentences.size() == 1)
        sentences.emplace_back("Protocol, number of participants and tests are as planned.");
    return sentences;
}

} // namespace physvib
