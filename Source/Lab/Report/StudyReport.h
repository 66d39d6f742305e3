// SPDX-License-Identifier: MIT
// The report of a study and the plan written before it, as files in memory.
#pragma once
#include "Io/Result.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Report/ReportTrials.h"
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
struct StudyReport {
    StudyFiles files;                         ///< file names within the report's folder, and contents:
                                              ///< index.html, tables, analysis.R for two or more people
    std::vector<std::string> notes;           ///< one line each on trials without a known analysis
    std::vector<std::string> tests;           ///< all tests that the script ran, in words
    std::string functionsText{}, slopeName{}; ///< which psychometric functions were fitted, and what their
                                              ///< jnd is
    std::string scriptError;                  ///< why the script did not end; empty: it did, or was not run
    bool isSimulated = false;                 ///< trials are of a simulated observer
};

/// Equal trials give identical bytes. Without `script` the page says how tests are run. Message thread only.
StudyReport studyReport(const ReportTrials& trials, const ScriptRunner& script = {});

// Options of a report on trial files: inputs, output folder and additional facts.

struct ReportJob {
    std::vector<std::string> files;           ///< trial files of one study
    std::vector<ColumnName> columns{};        ///< column mapping for tables of another program
    double guess = PsychometricModel{}.guess; ///< guess rate of functions, if no protocol gives it
    std::string folder;                       ///< output folder
    bool exportsBids = false;                 ///< also export the trials as a BIDS dataset
    bool exportsNotebook = false;             ///< also export a notebook of the script's steps
    std::string peoplePath{}; ///< table of facts on the participants (ReportTrials.h); empty: unknown
    std::string ethics{}, consent{}, noise{}; ///< sentences for the page; if empty, the page has a reminder

    std::string planPath{}; ///< plan of the study, made before it; empty: none

    bool operator==(const ReportJob&) const = default;
};

/// The report's files in memory, or an error line. `protocol`: given by the user; without it, a built-in one
/// is looked up. Message thread only.
Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callError, const ScriptRunner& script);

// The plan of a study, written before its first participant, and its comparison with the study in the report.

struct PlannedStudy {
    std::string text;   ///< design, number of participants, stop rules, exclusions, tests and corrections
    std::string script; ///< analysis.R as in the later report; empty for one participant
};

/// Lists the tests that the script runs on simulated participants. Message thread only.
Result<PlannedStudy> plannedStudy(const Protocol& protocol, int participants, const ScriptRunner& script);

/// Contents of a plan that a report compares with the study.
struct PlanFacts {
    std::string hash, participants;             ///< hash of the protocol; number of participants
    std::vector<std::string> tests, groupTests; ///< titles of tests; of those by group
    bool isListed = true;                       ///< R was available when the plan was written
};

/// Fails on a text that is no plan. Any thread (allocates).
Result<PlanFacts> readPlan(std::string_view plan, std::string_view name);

} // namespace physvib
