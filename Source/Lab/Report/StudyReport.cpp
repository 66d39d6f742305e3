// SPDX-License-Identifier: MIT
// Composes a report from the sections that fit its trials.
#include "Lab/Report/StudyReport.h"
#include "Lab/Files/LeftRows.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/ReportSections.h"
#include "Lab/Report/StudyPlanned.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>

namespace physvib {
namespace {

struct Section {
    std::string_view analysis;
    void (*tell)(ReportBuilder&);
};

constexpr Section sections[] = {{"confusion", tellIdentification}, {"resolution", tellPlaces},
                                {"places", tellPlaceErrors},       {"choices", tellChoices},
                                {"ratings", tellRatings},          {"levels", tellLevels}};

static_assert(std::ranges::all_of(studyTasks,
                                  [](const auto& task) {
                                      return task.analysis.empty() ||
                                             std::ranges::find(sections, task.analysis, &Section::analysis) !=
                                                 std::end(sections);
                                  }),
              "every task's analysis has its section");

std::string firstLine(const ReportTrials& trials) {
    Provenance provenance{PHYSVIB_VERSION, {{"report", "trials"}}};
    for (const char* key : {"protocol", "hash", "seed"})
        if (const std::string value = trials.common(key); !value.empty())
            provenance.entries.emplace_back(key, value);
    if (trials.isSimulated) provenance.entries.emplace_back("observer", "simulated");
    return provenanceComment(provenance);
}

std::string titleOf(const ReportTrials& trials) {
    if (trials.protocol) return "Report: " + trials.protocol->title;
    const std::string name = trials.common("protocol");
    return "Report: " + (name.empty() ? trials.files.front().name : name);
}

/// The same in a plan and in the report of the study.
std::string studyWords(const ReportTrials& trials) {
    std::string words = "physvib " PHYSVIB_VERSION;
    for (const char* key : {"protocol", "hash"})
        if (const std::string value = trials.common(key); !value.empty())
            words.append(", ").append(key).append(" ").append(value);
    return words;
}

void tellTests(ReportBuilder& report) {
    if (report.tests().empty()) return;
    report.page.heading("Tests");
    report.page.paragraph(
        "Tests: run `Rscript analysis.R` in this folder. It needs R alone (Debian: r-base-core), prints "
        "each test with its assumptions and writes tests.csv. It runs:");
    std::vector<std::string> words;
    for (const StudyTest& test : report.tests()) words.push_back(test.words());
    report.page.list(words);
}

} // namespace

StudyReport studyReport(const ReportTrials& trials) {
    StudyReport made;
    if (!trials.sharedNote.empty()) made.notes.push_back(trials.sharedNote);
    if (!trials.notLeft.empty()) made.notes.push_back(notLeftWords(trials.notLeft.size()));
    ReportBuilder report{trials, titleOf(trials)};
    report.addTable(trialsTable, trialsCsv(trials, firstLine(trials)));
    tellParticipants(report);
    tellProcedure(report);
    const auto kinds = analysesFor(trials.all);
    for (const Section& section : sections)
        if (std::ranges::find(kinds, section.analysis) != kinds.end()) section.tell(report);
    if (!tellDescriptions(report) && kinds.empty()) {
        made.notes.emplace_back(
            "no analysis is known for these trials: the report has their table and the participants only");
        report.page.heading("Results");
        report.page.note(made.notes.back());
        report.page.table(report.tableText(trialsTable), trialsTable);
    }
    for (const StudyTest& test : report.tests()) made.tests.push_back(test.words());
    tellTests(report);
    if (!trials.facts.plan.empty()) {
        report.page.heading("Planned and done");
        const auto compared = comparedWithPlan(trials.facts.plan, "plan", trials, made.tests);
        report.page.list(compared.value);
    }
    tellProvenance(report);
    made.files = report.tables();
    if (!report.tests().empty())
        made.files[analysisScriptName] = analysisScript(report.tests(), studyWords(trials));
    made.files["index.html"] = report.page.html();
    return made;
}

} // namespace physvib
