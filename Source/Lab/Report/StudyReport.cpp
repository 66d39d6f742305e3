// SPDX-License-Identifier: MIT
// Composes a report from the sections that fit its trials; writes plans from reports on simulated people.
#include "Lab/Report/StudyReport.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Provenance.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NameList.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/StudyTasks.h"
#include <ranges>
#include <set>

namespace physvib {
namespace {

struct Section {
    std::string_view analysis;
    void (*add)(ReportBuilder&);
};

constexpr Section sections[] = {{"confusion", addIdentificationSection}, {"resolution", addPlacesSection},
                                {"places", addPlaceErrorsSection},       {"choices", addChoicesSection},
                                {"ratings", addRatingsSection},          {"levels", addLevelsSection}};

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
        if (const std::string value = trials.commonValue(key); !value.empty())
            provenance.entries.emplace_back(key, value);
    if (trials.isSimulated) provenance.entries.emplace_back("observer", "simulated");
    return provenanceComment(provenance);
}

std::string makeTitle(const ReportTrials& trials) {
    if (trials.protocol) return "Report: " + trials.protocol->title;
    const std::string name = trials.commonValue("protocol");
    const std::size_t others = trials.files.size() - 1;
    return "Report: " + (!name.empty() ? name
                                       : trials.files.front().name +
                                             (others > 0 ? " and " + std::to_string(others) + " more" : ""));
}

/// One line that names the study, the same in its plan and in its report.
std::string studyLine(const ReportTrials& trials) {
    std::string words = "physvib " PHYSVIB_VERSION;
    for (const char* key : {"protocol", "hash"})
        if (const std::string value = trials.commonValue(key); !value.empty())
            words.append(", ").append(key).append(" ").append(value);
    return words;
}

/// Scales of points, whose scores are ordinal.
std::vector<std::string> ordinalScales(const ReportTrials& trials) {
    std::vector<std::string> scales;
    for (const SessionPlan& session : trials.sessions())
        if (session.points > 0) scales.insert(scales.end(), session.scores().begin(), session.scores().end());
    return scales;
}

/// Shows a table for each test of analysis.R, then the data left out and the tests not made.
void addTests(ReportPage& page, const CsvTable& all) {
    // columns, separated by |; NAME=HEADING if the page has another heading
    constexpr std::string_view testColumns =
        "effect|statistic|df1|df2|value|p|correction|epsilon|p_corrected|across|p_across|size|effect_size|n|"
        "difference|least=95 % interval, least|most=95 % interval, most|note";
    const Cells cell{all};
    const auto show = [&](std::string_view columns, const auto& isOf) {
        std::vector<std::string_view> names, headings;
        while (!columns.empty()) {
            std::string_view heading = takeUntil('|', columns);
            names.push_back(takeUntil('=', heading));
            headings.push_back(heading.empty() ? names.back() : heading);
        }
        std::string csv = csvLine(headings);
        for (const CsvRow& row : all.rows)
            if (isOf(row))
                csv += csvLine(std::views::transform(names, [&](auto name) { return cell(row, name); }));
        page.addTable(csv, testsTable, 200);
    };
    const auto isTest = [&](const CsvRow& row) {
        return cell(row, "kind") == "test" || cell(row, "kind") == "assumption";
    };
    std::set<std::string> listedTests;
    for (const CsvRow& first : all.rows) {
        const bool isMean = cell(first, "kind") == "mean";
        if ((!isMean && !isTest(first)) || !listedTests.insert(cell(first, "test")).second) continue;
        page.addSubheading(cell(first, "test"));
        show(isMean ? "effect=level|statistic|value|effect_size=SD|n" : testColumns, [&](const CsvRow& row) {
            return cell(row, "test") == cell(first, "test") && (isMean || isTest(row));
        });
    }
    page.addSubheading("Left out of tests, averaged over, chance");
    show("test=of|effect=what|n=n kept|note=which",
         [&](const CsvRow& row) { return cell(row, "kind") == "note"; });
    const auto isNone = [&](const CsvRow& row) { return cell(row, "kind") == "not made"; };
    if (std::ranges::none_of(all.rows, isNone)) return;
    page.addSubheading("Not tested");
    show("test|effect|n|note=why", isNone);
}

/// Name of the only factor of the protocol's stimuli; empty if there are several or none.
std::string stimulusFactor(const ReportTrials& trials) {
    std::set<std::string> names;
    if (trials.protocol)
        for (const ConditionPlan& condition : trials.protocol->conditions) {
            const CallSet* const calls = findCalls(condition.stimuli);
            names.insert(calls != nullptr && calls->factors.size() == 1 ? calls->factors.front().name
                                                                        : std::string{});
        }
    return names.size() == 1 ? *names.begin() : std::string{};
}

/// Runs analysis.R and shows its tests, or says how to run it.
void addTestsSection(ReportBuilder& report, StudyReport& result, const ScriptRunner& run) {
    report.page.addHeading("Tests over participants");
    StudyFiles files = report.tables();
    files[analysisScriptName] = result.files[analysisScriptName];
    auto scriptFiles = run ? run(files) : Result<StudyFiles>{StudyFiles{}};
    if (!scriptFiles) {
        result.scriptError = "analysis.R did not end: " + scriptFiles.error;
        return report.page.addNote(result.scriptError);
    }
    if (scriptFiles.value.empty())
        return report.page.addParagraph("Not run: `Rscript analysis.R` (Debian: r-base-core).");
    const std::string table = scriptFiles.value[testsTable];
    result.tests = testNames(table);
    report.page.addParagraph(
        "analysis.R, " + table.substr(std::min<std::size_t>(2, table.size()), table.find('\n') - 2) + ".");
    if (const std::string factor = stimulusFactor(report.trials); !factor.empty())
        report.page.addParagraph("stimulus: the protocol's factor " + factor + ".");
    if (const auto read = readCsvTable(table, testsTable); read && !read.value.rows.empty())
        addTests(report.page, read.value);
    else
        report.page.addParagraph("No test: there is nothing to be compared over two participants or more.");
    std::vector<std::string> tables;
    for (const auto& [name, text] : scriptFiles.value) tables.push_back(name);
    report.page.addParagraph("Tables by R: " + joinNames(tables, ", ") + ".");
    result.files.merge(scriptFiles.value);
}

/// Adds a table that compares the plan with the study, line by line.
void addPlanComparison(ReportBuilder& report, const StudyReport& result) {
    const ReportTrials& trials = report.trials;
    const PlanFacts plan = readPlan(trials.facts.plan, "plan").value;
    const bool areKnown = report.participantCount() < 2 || result.files.contains(testsTable);
    const auto& planned =
        trials.all.column(trialColumns::group) && !plan.groupTests.empty() ? plan.groupTests : plan.tests;
    std::set<std::string> people, tests{result.tests.begin(), result.tests.end()};
    for (const TrialFile& file : trials.files)
        if (const auto column = file.table.column("participant"))
            for (const CsvRow& row : file.table.rows) people.insert(row.cells[*column]);
    tests.insert(planned.begin(), planned.end());
    ExportTable table{"plan", report.isSimulated(), "what,planned,done"};
    table.row("hash of the plan", contentHash(trials.facts.plan), "");
    table.row("hash of the protocol", plan.hash, trials.commonValue("hash"));
    table.row("participants", plan.participants, people.size());
    const auto yesOrNo = [](bool isKnown, const auto& all, const std::string& test) {
        return !isKnown ? "not known" : std::ranges::find(all, test) != all.end() ? "yes" : "no";
    };
    for (const std::string& test : tests)
        table.row(test, yesOrNo(plan.isListed, planned, test), yesOrNo(areKnown, result.tests, test));
    report.page.addHeading("Planned and done");
    report.page.addTable(table.text(), "plan", 200);
}

} // namespace

StudyReport studyReport(const ReportTrials& trials, const ScriptRunner& script) {
    StudyReport result;
    result.notes = trials.notes;
    if (!trials.undelivered.empty()) result.notes.push_back(undeliveredNote(trials.undelivered.size()));
    ReportBuilder report{trials, makeTitle(trials)};
    report.addTable(trialsTable, trialsCsv(trials, firstLine(trials)));
    addParticipantsSection(report);
    addProcedureSection(report);
    const auto kinds = analysesFor(trials.all);
    for (const Section& section : sections)
        if (std::ranges::find(kinds, section.analysis) != kinds.end()) section.add(report);
    if (!addDescriptionsSection(report) && kinds.empty()) {
        result.notes.emplace_back("no analysis is known of these columns");
        report.page.addHeading("Trials");
        report.page.addTable(report.tableText(trialsTable), trialsTable);
    }
    if (report.participantCount() > 1) {
        result.files[analysisScriptName] =
            analysisScript(studyLine(trials), report.scales, ordinalScales(trials), report.midpointName,
                           trials.protocol.has_value());
        addTestsSection(report, result, script);
    }
    if (!trials.facts.plan.empty()) addPlanComparison(report, result);
    addProvenanceSection(report);
    result.functionsText = report.functionsText, result.slopeName = report.slopeName;
    result.files.insert(report.tables().begin(), report.tables().end());
    result.files["index.html"] = report.page.html();
    return result;
}

// Reads the input files of a report job and creates the report.

namespace {

void addBids(StudyReport& report, const ReportTrials& trials) {
    BidsDescription words{trials.protocol ? trials.protocol->title : trials.files.front().name,
                          trials.commonValue("protocol"),
                          PHYSVIB_VERSION,
                          {},
                          trials.isSimulated};
    if (words.task.empty()) words.task = trials.files.front().name;
    for (const SessionPlan& session : trials.sessions())
        for (const auto& scale : session.scores()) words.columns[scale] = scoreText(session, scale);
    for (const char* key : {"hash", "seed", "version"})
        if (const std::string value = trials.commonValue(key); !value.empty()) words.source[key] = value;
    for (auto& [name, text] : bidsDataset(trials.all, words)) report.files["bids/" + name] = std::move(text);
}

} // namespace

Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callError, const ScriptRunner& script) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const std::string& path : job.files) {
        auto text = readFile(path, limits::maxTableBytes);
        if (!text) return Failure{text.error};
        texts.emplace_back(path, std::move(text.value));
    }
    auto trials = readReportTrials(texts, job.columns, protocol, callError);
    if (!trials) return Failure{trials.error};
    for (std::size_t i = 0; i < job.files.size(); ++i) {
        auto times = loadStudyTimes(timesPath(job.files[i]));
        if (!times) return Failure{times.error};
        trials.value.files[i].times = std::move(times.value);
    }
    trials.value.columns = job.columns;
    trials.value.guess = job.guess;
    if (trials.value.all.column("target_x") && !trials.value.all.column("target_column")) // need one unit
        if (std::string error = unitError(job.columns); !error.empty()) return Failure{std::move(error)};
    StudyFacts facts{{}, job.ethics, job.consent, job.noise};
    if (!job.planPath.empty()) {
        auto plan = readFile(job.planPath, limits::maxTableBytes);
        if (!plan) return Failure{plan.error};
        if (const auto read = readPlan(plan.value, job.planPath); !read) return Failure{read.error};
        facts.plan = std::move(plan.value);
    }
    if (!job.peoplePath.empty()) {
        const auto text = readFile(job.peoplePath, limits::maxTableBytes);
        auto people = text ? readParticipantFacts(text.value, job.peoplePath)
                           : Result<std::vector<ParticipantFacts>>{Failure{text.error}};
        if (!people) return Failure{people.error};
        facts.people = std::move(people.value);
    }
    if (std::string error = applyFacts(trials.value, std::move(facts)); !error.empty())
        return Failure{std::move(error)};
    StudyReport report = studyReport(trials.value, script);
    report.isSimulated = trials.value.isSimulated;
    if (job.exportsNotebook && report.files.contains(analysisScriptName))
        report.files[notebookName] = analysisNotebook(studyLine(trials.value));
    if (!job.exportsBids) return report;
    if (!trials.value.all.column("participant"))
        return Failure{job.files.front() + ": --bids: expected a column participant, found none"};
    addBids(report, trials.value);
    return report;
}

// Writes plans by simulation: analysis.R itself lists the tests that it will run.

namespace {

constexpr int maxSimulatedPeople = 6; // as many as the tests need; more would not change them
constexpr std::string_view notListed =
    "not listed, as R (Debian: r-base-core) was not there: analysis.R chooses";
constexpr std::string_view testPrefix = "- test: ", groupTestPrefix = "- test by group: ";

std::string makeCode(int number) { return std::string("P").append(std::to_string(number)); }

/// Replaces adjustments and adaptive answers so that levels stay near the middle of their range.
void answerNearMiddle(const Experiment& experiment, SeededRandom& random, Answer& answer) {
    const SessionPlan& session = experiment.session();
    const double middle = 0.5 + 0.1 * random.normal();
    const auto midLevel = [&](const auto& plan) { return plan.minDb + middle * (plan.maxDb - plan.minDb); };
    if (const auto& plan = session.adjustment)
        answer.value = std::round(midLevel(*plan) / plan->stepDb) * plan->stepDb;
    const std::string* const adapted = session.adaptedAlternative();
    if (adapted == nullptr) return;
    const double threshold = session.quest ? midLevel(*session.quest) : midLevel(*session.staircase);
    answer.response = experiment.trial().levelDb > threshold
                          ? *adapted
                          : std::ranges::find_if(session.alternatives, [&](const Alternative& one) {
                                return one.name != *adapted;
                            })->name;
}

std::string simulatedFile(const Protocol& protocol, int number) {
    const Participant participant{makeCode(number), number, "simulated"};
    Protocol rehearsal = protocol;
    for (SessionPlan& session : rehearsal.sessions) { // enough trials for every possible answer
        if (!session.correct.empty() || session.answers.size() == 2)
            session.repetitions = std::max(session.repetitions, 100);
        if (session.staircase) session.staircase->maxTrials = std::max(session.staircase->maxTrials, 1000);
        if (session.quest) session.quest->trials = std::max(session.quest->trials, 40);
    }
    Experiment experiment{rehearsal, participant};
    ObserverSettings observerSettings; // errors, so that nobody is always right
    observerSettings.placeBlur = 0.4, observerSettings.pulsePlaceConfusion = 0.3;
    const SimulatedObserver observer{observerSettings, rehearsal, participant};
    SeededRandom random{static_cast<std::uint64_t>(protocol.seed), "plan/" + participant.code};
    std::string text = trialHeader(protocol, participant, PHYSVIB_VERSION);
    while (!experiment.isDone()) {
        Answer answer = observer.answer(experiment);
        if (!answer.timedOut) answerNearMiddle(experiment, random, answer);
        TrialRecord record = experiment.acceptAnswer(std::move(answer));
        text += trialRow(protocol, participant, record);
        if (record.trial.condition > 0 || record.trial.number > 1 ||
            protocol.sessions[record.trial.session].answerSeconds <= 0.0)
            continue;
        record.trial.number = 1'000'000; // a trial that timed out, since their share is tested too
        record.answer = Answer{}, record.answer.timedOut = true;
        text += trialRow(protocol, participant, record);
    }
    return text;
}

/// Assigns participants to two groups, as a table of people can do.
void assignTwoGroups(ReportTrials& trials, int participants) {
    StudyFacts facts;
    for (int number = 1; number <= std::min(participants, maxSimulatedPeople); ++number)
        facts.people.push_back({makeCode(number), {}, {}, {}, {}, number % 2 == 0 ? "one" : "other"});
    applyFacts(trials, std::move(facts));
}

std::string listText(const char* title, const std::vector<std::string>& lines) {
    std::string text = "\n";
    text.append(title).append("\n");
    for (const std::string& line : lines) text.append("- ").append(line).append("\n");
    return text;
}

/// Corrections of p in a table of tests, without the numbers of tests.
std::set<std::string> findCorrections(const std::string& table) {
    std::set<std::string> all;
    const auto read = readCsvTable(table, testsTable);
    const Cells cell{read.value};
    for (const CsvRow& row : read.value.rows) {
        const auto name = [&](const char* column) {
            const std::string& words = cell(row, column);
            return words.substr(0, words.find(','));
        };
        const std::string& title = cell(row, "test");
        constexpr std::string_view variance = "analysis of variance";
        const std::string test =
            title.substr(0, title.find(" of ", title.starts_with(variance) ? variance.size() : 0));
        if (const std::string words = name("correction"); !words.empty()) all.insert(test + ": " + words);
        if (const std::string& across = cell(row, "across"); !across.empty())
            all.insert(test + ": " + name("across") +
                       across.substr(std::min(across.size(), across.find(" over "))));
    }
    return all;
}

/// Definitions of the measures that these sessions have, and what is left out of them.
std::string measuresText(const Protocol& protocol, int participants, const StudyReport& report) {
    const auto has = [&](auto predicate) {
        return std::ranges::any_of(protocol.sessions,
                                   [&](const auto& s) { return !s.isTraining && predicate(s); });
    };
    const auto isOf = [&](AnswerKind kind) {
        return has([=](const SessionPlan& s) { return s.answerKind() == kind && !s.adaptedAlternative(); });
    };
    const bool hasStaircase = has([](const SessionPlan&s) { return s.staircase.has_value(); }),
               hasQuest = has([](const SessionPlan&s) { return s.quest.has_value(); }),
               hasFunctions = report.files.contains("psychometric-stimuli.csv");
    std::vector<std::string> measures,
        exclusions{
            "people with a reason in the table of people",
            "trials that did not leave as planned, ran out of time or have no answer", "trainings",
            "tests: who lacks a level; factors of which fewer than half of the people have all levels"};
    const auto add = [&](bool isUsed, std::string measure, const std::string& exclusion = {}) {
        if (!isUsed) return;
        measures.push_back(std::move(measure));
        if (!exclusion.empty()) exclusions.push_back(exclusion);
    };
    add(hasStaircase,
        "threshold of a staircase: mean of the later half of the reversals of the level that a trial "
        "followed; of several staircases their mean",
        "staircases: unfinished, of fewer than two reversals, or with half or more of the trials or of the "
        "reversals that count at an end of the levels");
    add(hasQuest,
        participants > 1 ? "threshold by QUEST+: posterior mean, with the widths of all participants together"
                         : "threshold by QUEST+: posterior mean",
        "QUEST+: unfinished, or within half a step of an end of the levels");
    add(hasFunctions,
        "threshold and " + report.slopeName +
            " of a function: level half way up, and half of what lies between a quarter and "
            "three quarters; maximum likelihood, " +
            report.functionsText,
        "functions: not rising, a constant fits as well (likelihood ratio, p > 0.05), width of 20 times the "
        "range of the levels, threshold outside it; of a step the " +
            report.slopeName);
    add(has([](const SessionPlan& s) { return s.adjustment.has_value(); }), "matched level: mean, dB");
    add(isOf(AnswerKind::number), "magnitude: geometric mean; exponent: slope of logarithms, least squares");
    add(has([](const SessionPlan& s) { return s.comparesPairs; }),
        "pairs of stimuli: means (similarity.csv), classical scaling (mds.csv); distance: score of scales "
        "that begin with dis or diff, else 100 or the number of points less the score");
    add(isOf(AnswerKind::label),
        "percent correct; information transfer, from 5 trials per cell on less Miller's bias");
    add(isOf(AnswerKind::place), "place: mean of x and of y; variable error: standard deviation around it");
    add(isOf(AnswerKind::choice), "choice: share of an alternative");
    add(isOf(AnswerKind::scores), "scale: mean score");
    return listText("Measures, of each participant", measures) + listText("Exclusions", exclusions);
}

} // namespace

Result<PlannedStudy> plannedStudy(const Protocol& protocol, int participants, const ScriptRunner& script) {
    std::vector<std::pair<std::string, std::string>> files;
    for (int number = 1; number <= std::min(participants, maxSimulatedPeople); ++number)
        files.emplace_back(makeCode(number), simulatedFile(protocol, number));
    auto trials = readReportTrials(files, {}, protocol);
    if (!trials) return Failure{trials.error};
    auto report = studyReport(trials.value, script);
    if (!report.scriptError.empty()) return Failure{report.scriptError};
    std::vector<std::string> conditions, sessions, tests;
    for (const std::string& test : report.tests) tests.push_back("test: " + test);
    for (const auto& condition : protocol.conditions) conditions.push_back(conditionText(condition));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionText(session));
    std::string text = provenanceComment({PHYSVIB_VERSION,
                                          {{"plan", "study"},
                                           {"protocol", protocol.name},
                                           {"hash", protocolHash(protocol)},
                                           {"participants", std::to_string(participants)}}});
    text += listText("Protocol, by the fields of its file", {protocolText(protocol)});
    text += listText("Conditions", conditions) + listText("Sessions, each in each condition", sessions);
    text += listText("Participants", {std::to_string(participants)});
    text += measuresText(protocol, participants, report);
    const bool isListed = participants < 2 || report.files.contains(testsTable);
    const auto corrections = findCorrections(report.files[testsTable]);
    text += listText("Corrections", {corrections.begin(), corrections.end()});
    text += listText("Tests over participants, as analysis.R runs them in R", tests);
    if (tests.empty()) text += (isListed ? "none" : std::string{notListed}) + "\n";
    if (participants >= 4 && report.files.contains(testsTable)) { // two of each group
        assignTwoGroups(trials.value, participants);
        auto groupReport = studyReport(trials.value, script);
        for (std::string& test : groupReport.tests) test.insert(0, groupTestPrefix.substr(2));
        if (const auto& groupTests = groupReport.tests; !groupTests.empty())
            text += listText("In their place, by group (two groups in people.csv)", groupTests);
    }
    return PlannedStudy{std::move(text), std::move(report.files[analysisScriptName])};
}

Result<PlanFacts> readPlan(std::string_view plan, std::string_view name) {
    std::string_view rest = plan, first = takeUntil('\n', rest);
    const TrialHead head =
        parseTrialHead({std::string{first.substr(std::min<std::size_t>(1, first.size()))}});
    if (!head.contains("plan") || !head.contains("hash") || !head.contains("participants"))
        return Failure{std::string{name} + ":1: expected a plan of `physvib study plan`"};
    PlanFacts facts{head.at("hash"), head.at("participants"), {}, {}, plan.find(notListed) == plan.npos};
    while (!rest.empty()) {
        const std::string_view line = takeUntil('\n', rest);
        for (const auto& [prefix, tests] :
             {std::pair{testPrefix, &facts.tests}, {groupTestPrefix, &facts.groupTests}})
            if (line.starts_with(prefix)) tests->emplace_back(line.substr(prefix.size()));
    }
    return facts;
}

} // namespace physvib
