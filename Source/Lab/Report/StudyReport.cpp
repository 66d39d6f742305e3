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
    const std::size_t others = trials.files.size() - 1;
    return "Report: " + (!name.empty() ? name
                                       : trials.files.front().name +
                                             (others > 0 ? " and " + std::to_string(others) + " more" : ""));
}

/// The same in a plan and in the report of the study.
std::string studyWords(const ReportTrials& trials) {
    std::string words = "physvib " PHYSVIB_VERSION;
    for (const char* key : {"protocol", "hash"})
        if (const std::string value = trials.common(key); !value.empty())
            words.append(", ").append(key).append(" ").append(value);
    return words;
}

/// Scales of so many points, whose scores have an order and no distances.
std::vector<std::string> inPoints(const ReportTrials& trials) {
    std::vector<std::string> scales;
    for (const SessionPlan& session : trials.sessions())
        if (session.points > 0) scales.insert(scales.end(), session.scores().begin(), session.scores().end());
    return scales;
}

/// What analysis.R wrote: a table for each test, then what was left out, and what was not tested.
void tellTests(ReportPage& page, const CsvTable& all) {
    // names of columns, some with a heading of the page's own
    constexpr std::string_view ofTests =
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
        page.table(csv, testsTable, 200);
    };
    const auto isTest = [&](const CsvRow& row) {
        return cell(row, "kind") == "test" || cell(row, "kind") == "assumption";
    };
    std::set<std::string> told;
    for (const CsvRow& one : all.rows) {
        const bool isMean = cell(one, "kind") == "mean";
        if ((!isMean && !isTest(one)) || !told.insert(cell(one, "test")).second) continue;
        page.subheading(cell(one, "test"));
        show(isMean ? "effect=level|statistic|value|effect_size=SD|n" : ofTests, [&](const CsvRow& row) {
            return cell(row, "test") == cell(one, "test") && (isMean || isTest(row));
        });
    }
    page.subheading("Left out of tests, averaged over, chance");
    show("test=of|effect=what|n=n kept|note=which",
         [&](const CsvRow& row) { return cell(row, "kind") == "note"; });
    const auto isNone = [&](const CsvRow& row) { return cell(row, "kind") == "not made"; };
    if (std::ranges::none_of(all.rows, isNone)) return;
    page.subheading("Not tested");
    show("test|effect|n|note=why", isNone);
}

/// What the protocol calls the one thing that tells stimuli apart; empty: several, or none.
std::string stimulusFactor(const ReportTrials& trials) {
    std::set<std::string> names;
    if (trials.protocol)
        for (const ConditionPlan& condition : trials.protocol->conditions) {
            const CallSet* const calls = callSetOf(condition.stimuli);
            names.insert(calls != nullptr && calls->factors.size() == 1 ? calls->factors.front().name
                                                                        : std::string{});
        }
    return names.size() == 1 ? *names.begin() : std::string{};
}

/// What analysis.R finds, if it can be run here, and how else to run it.
void runTests(ReportBuilder& report, StudyReport& made, const ScriptRunner& run) {
    report.page.heading("Tests over participants");
    StudyFiles files = report.tables();
    files[analysisScriptName] = made.files[analysisScriptName];
    auto ran = run ? run(files) : Result<StudyFiles>{StudyFiles{}};
    if (!ran) {
        made.scriptFault = "analysis.R did not end: " + ran.error;
        return report.page.note(made.scriptFault);
    }
    if (ran.value.empty())
        return report.page.paragraph("Not run: `Rscript analysis.R` (Debian: r-base-core).");
    const std::string table = ran.value[testsTable];
    made.tests = testsIn(table);
    report.page.paragraph("analysis.R, " +
                          table.substr(std::min<std::size_t>(2, table.size()), table.find('\n') - 2) + ".");
    if (const std::string factor = stimulusFactor(report.trials); !factor.empty())
        report.page.paragraph("stimulus: the protocol's factor " + factor + ".");
    if (const auto read = readCsvTable(table, testsTable); read && !read.value.rows.empty())
        tellTests(report.page, read.value);
    else
        report.page.paragraph("No test: there is nothing to be compared over two participants or more.");
    std::vector<std::string> tables;
    for (const auto& [name, text] : ran.value) tables.push_back(name);
    report.page.paragraph("Tables by R: " + joined(tables, ", ") + ".");
    made.files.merge(ran.value);
}

/// The plan beside what was done, line by line.
void tellPlan(ReportBuilder& report, const StudyReport& made) {
    const ReportTrials& trials = report.trials;
    const PlanFacts plan = readPlan(trials.facts.plan, "plan").value;
    const bool areKnown = report.people() < 2 || made.files.contains(testsTable);
    const auto& planned =
        trials.all.column(trialColumns::group) && !plan.grouped.empty() ? plan.grouped : plan.tests;
    std::set<std::string> people, tests{made.tests.begin(), made.tests.end()};
    for (const TrialFile& file : trials.files)
        if (const auto column = file.table.column("participant"))
            for (const CsvRow& row : file.table.rows) people.insert(row.cells[*column]);
    tests.insert(planned.begin(), planned.end());
    ExportTable table{"plan", report.isSimulated(), "what,planned,done"};
    table.row("hash of the plan", contentHash(trials.facts.plan), "");
    table.row("hash of the protocol", plan.hash, trials.common("hash"));
    table.row("participants", plan.participants, people.size());
    const auto word = [](bool isKnown, const auto& all, const std::string& test) {
        return !isKnown ? "not known" : std::ranges::find(all, test) != all.end() ? "yes" : "no";
    };
    for (const std::string& test : tests)
        table.row(test, word(plan.isListed, planned, test), word(areKnown, made.tests, test));
    report.page.heading("Planned and done");
    report.page.table(table.text(), "plan", 200);
}

} // namespace

StudyReport studyReport(const ReportTrials& trials, const ScriptRunner& script) {
    StudyReport made;
    made.notes = trials.notes;
    if (!trials.notLeft.empty()) made.notes.push_back(notLeftWords(trials.notLeft.size()));
    ReportBuilder report{trials, titleOf(trials)};
    report.addTable(trialsTable, trialsCsv(trials, firstLine(trials)));
    tellParticipants(report);
    tellProcedure(report);
    const auto kinds = analysesFor(trials.all);
    for (const Section& section : sections)
        if (std::ranges::find(kinds, section.analysis) != kinds.end()) section.tell(report);
    if (!tellDescriptions(report) && kinds.empty()) {
        made.notes.emplace_back("no analysis is known of these columns");
        report.page.heading("Trials");
        report.page.table(report.tableText(trialsTable), trialsTable);
    }
    if (report.people() > 1) {
        made.files[analysisScriptName] = analysisScript(studyWords(trials), report.scales, inPoints(trials),
                                                        report.half, trials.protocol.has_value());
        runTests(report, made, script);
    }
    if (!trials.facts.plan.empty()) tellPlan(report, made);
    tellProvenance(report);
    made.functions = report.functions, made.slope = report.slope;
    made.files.insert(report.tables().begin(), report.tables().end());
    made.files["index.html"] = report.page.html();
    return made;
}

// Reads the input files of a report job and creates the report.

namespace {

void addBids(StudyReport& report, const ReportTrials& trials) {
    BidsWords words{trials.protocol ? trials.protocol->title : trials.files.front().name,
                    trials.common("protocol"),
                    PHYSVIB_VERSION,
                    {},
                    trials.isSimulated};
    if (words.task.empty()) words.task = trials.files.front().name;
    for (const SessionPlan& session : trials.sessions())
        for (const auto& scale : session.scores()) words.columns[scale] = scoreWords(session, scale);
    for (const char* key : {"hash", "seed", "version"})
        if (const std::string value = trials.common(key); !value.empty()) words.source[key] = value;
    for (auto& [name, text] : bidsDataset(trials.all, words)) report.files["bids/" + name] = std::move(text);
}

} // namespace

Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callFault, const ScriptRunner& script) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const std::string& path : job.files) {
        auto text = readFile(path, limits::maxTableBytes);
        if (!text) return Failure{text.error};
        texts.emplace_back(path, std::move(text.value));
    }
    auto trials = readReportTrials(texts, job.columns, protocol, callFault);
    if (!trials) return Failure{trials.error};
    for (std::size_t i = 0; i < job.files.size(); ++i) {
        auto times = loadStudyTimes(timesPathOf(job.files[i]));
        if (!times) return Failure{times.error};
        trials.value.files[i].times = std::move(times.value);
    }
    trials.value.columns = job.columns;
    trials.value.guess = job.guess;
    if (trials.value.all.column("target_x") && !trials.value.all.column("target_column")) // need one unit
        if (std::string fault = unitFault(job.columns); !fault.empty()) return Failure{std::move(fault)};
    StudyFacts facts{{}, job.ethics, job.consent, job.noise};
    if (!job.planPath.empty()) {
        auto plan = readFile(job.planPath, limits::maxTableBytes);
        if (!plan) return Failure{plan.error};
        if (const auto read = readPlan(plan.value, job.planPath); !read) return Failure{read.error};
        facts.plan = std::move(plan.value);
    }
    if (!job.peoplePath.empty()) {
        const auto text = readFile(job.peoplePath, limits::maxTableBytes);
        auto people = text ? readPeople(text.value, job.peoplePath)
                           : Result<std::vector<PersonFacts>>{Failure{text.error}};
        if (!people) return Failure{people.error};
        facts.people = std::move(people.value);
    }
    if (std::string fault = takeFacts(trials.value, std::move(facts)); !fault.empty())
        return Failure{std::move(fault)};
    StudyReport report = studyReport(trials.value, script);
    report.isSimulated = trials.value.isSimulated;
    if (job.wantsNotebook && report.files.contains(analysisScriptName))
        report.files[notebookName] = analysisNotebook(studyWords(trials.value));
    if (!job.wantsBids) return report;
    if (!trials.value.all.column("participant"))
        return Failure{job.files.front() + ": --bids: expected a column participant, found none"};
    addBids(report, trials.value);
    return report;
}

// Plans by simulation: the tests of a plan are written by what will run them.

namespace {

constexpr int mostSimulated = 6; // as many as tests need; more change no test's call
constexpr std::string_view notListed =
    "not listed, as R (Debian: r-base-core) was not there: analysis.R chooses";
constexpr std::string_view testMark = "- test: ", groupedMark = "- test by group: ";

std::string codeOf(int number) { return std::string("P").append(std::to_string(number)); }

/// Sets and finds levels about the middle of their range, whatever the observer feels: none at an end.
void answerWithin(const Experiment& experiment, SeededRandom& random, Answer& answer) {
    const SessionPlan& session = experiment.session();
    const double middle = 0.5 + 0.1 * random.normal();
    const auto levelIn = [&](const auto& plan) {
        return plan.leastDb + middle * (plan.mostDb - plan.leastDb);
    };
    if (const auto& plan = session.adjustment)
        answer.value = std::round(levelIn(*plan) / plan->stepDb) * plan->stepDb;
    const std::string* const moved = session.adaptedAlternative();
    if (moved == nullptr) return;
    const double threshold = session.quest ? levelIn(*session.quest) : levelIn(*session.staircase);
    answer.response = experiment.trial().levelDb > threshold
                          ? *moved
                          : std::ranges::find_if(session.alternatives, [&](const Alternative& one) {
                                return one.name != *moved;
                            })->name;
}

std::string simulatedFile(const Protocol& protocol, int number) {
    const Participant participant{codeOf(number), number, "simulated"};
    Protocol rehearsal = protocol;
    for (SessionPlan& session : rehearsal.sessions) { // so that each value is found that there may be
        if (!session.correct.empty() || session.answers.size() == 2)
            session.repetitions = std::max(session.repetitions, 100);
        if (session.staircase) session.staircase->mostTrials = std::max(session.staircase->mostTrials, 1000);
        if (session.quest) session.quest->trials = std::max(session.quest->trials, 40);
    }
    Experiment experiment{rehearsal, participant};
    ObserverSettings errs; // nobody is always right
    errs.placeBlur = 0.4, errs.pulsePlaceConfusion = 0.3;
    const SimulatedObserver observer{errs, rehearsal, participant};
    SeededRandom random{static_cast<std::uint64_t>(protocol.seed), "plan/" + participant.code};
    std::string text = trialHeader(protocol, participant, PHYSVIB_VERSION);
    while (!experiment.isDone()) {
        Answer answer = observer.answer(experiment);
        if (!answer.ranOut) answerWithin(experiment, random, answer);
        TrialRecord record = experiment.take(std::move(answer));
        text += trialRow(protocol, participant, record);
        if (record.trial.condition > 0 || record.trial.number > 1 ||
            protocol.sessions[record.trial.session].answerSeconds <= 0.0)
            continue;
        record.trial.number = 1'000'000; // one more, as how often time runs out is tested, too
        record.answer = Answer{}, record.answer.ranOut = true;
        text += trialRow(protocol, participant, record);
    }
    return text;
}

/// Assigns people to two groups, as a table of people would.
void takeTwoGroups(ReportTrials& trials, int participants) {
    StudyFacts facts;
    for (int number = 1; number <= std::min(participants, mostSimulated); ++number)
        facts.people.push_back({codeOf(number), {}, {}, {}, {}, number % 2 == 0 ? "one" : "other"});
    takeFacts(trials, std::move(facts));
}

std::string listOf(const char* title, const std::vector<std::string>& lines) {
    std::string text = "\n";
    text.append(title).append("\n");
    for (const std::string& line : lines) text.append("- ").append(line).append("\n");
    return text;
}

/// How p are corrected in a table of tests, without the numbers of tests.
std::set<std::string> correctionsIn(const std::string& table) {
    std::set<std::string> all;
    const auto read = readCsvTable(table, testsTable);
    const Cells cell{read.value};
    for (const CsvRow& row : read.value.rows) {
        const auto name = [&](const char* column) {
            const std::string& words = cell(row, column);
            return words.substr(0, words.find(','));
        };
        const std::string& whole = cell(row, "test");
        constexpr std::string_view variance = "analysis of variance";
        const std::string test =
            whole.substr(0, whole.find(" of ", whole.starts_with(variance) ? variance.size() : 0));
        if (const std::string words = name("correction"); !words.empty()) all.insert(test + ": " + words);
        if (const std::string& across = cell(row, "across"); !across.empty())
            all.insert(test + ": " + name("across") +
                       across.substr(std::min(across.size(), across.find(" over "))));
    }
    return all;
}

/// Definitions of the measures that these sessions have, and what is left out of them.
std::string measuresOf(const Protocol& protocol, int participants, const StudyReport& report) {
    const auto has = [&](auto is) {
        return std::ranges::any_of(protocol.sessions, [&](const auto& s) { return !s.isTraining && is(s); });
    };
    const auto isOf = [&](AnswerKind kind) {
        return has([=](const SessionPlan& s) { return s.answer() == kind && !s.adaptedAlternative(); });
    };
    const bool hasStaircase = has([](const SessionPlan&s) { return s.staircase.has_value(); }),
               hasQuest = has([](const SessionPlan&s) { return s.quest.has_value(); }),
               hasFunctions = report.files.contains("psychometric-stimuli.csv");
    std::vector<std::string> measures,
        exclusions{
            "people with a reason in the table of people",
            "trials that did not leave as planned, ran out of time or have no answer", "trainings",
            "tests: who lacks a level; factors of which fewer than half of the people have all levels"};
    const auto add = [&](bool isThere, std::string measure, const std::string& exclusion = {}) {
        if (!isThere) return;
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
        "threshold and " + report.slope +
            " of a function: level half way up, and half of what lies between a quarter and "
            "three quarters; maximum likelihood, " +
            report.functions,
        "functions: not rising, a constant fits as well (likelihood ratio, p > 0.05), width of 20 times the "
        "range of the levels, threshold outside it; of a step the " +
            report.slope);
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
    return listOf("Measures, of each participant", measures) + listOf("Exclusions", exclusions);
}

} // namespace

Result<PlannedStudy> plannedStudy(const Protocol& protocol, int participants, const ScriptRunner& script) {
    std::vector<std::pair<std::string, std::string>> files;
    for (int number = 1; number <= std::min(participants, mostSimulated); ++number)
        files.emplace_back(codeOf(number), simulatedFile(protocol, number));
    auto trials = readReportTrials(files, {}, protocol);
    if (!trials) return Failure{trials.error};
    auto report = studyReport(trials.value, script);
    if (!report.scriptFault.empty()) return Failure{report.scriptFault};
    std::vector<std::string> conditions, sessions, tests;
    for (const std::string& test : report.tests) tests.push_back("test: " + test);
    for (const auto& one : protocol.conditions) conditions.push_back(conditionWords(one));
    for (const SessionPlan& session : protocol.sessions) sessions.push_back(sessionWords(session));
    std::string text = provenanceComment({PHYSVIB_VERSION,
                                          {{"plan", "study"},
                                           {"protocol", protocol.name},
                                           {"hash", protocolHash(protocol)},
                                           {"participants", std::to_string(participants)}}});
    text += listOf("Protocol, by the fields of its file", {protocolWords(protocol)});
    text += listOf("Conditions", conditions) + listOf("Sessions, each in each condition", sessions);
    text += listOf("Participants", {std::to_string(participants)});
    text += measuresOf(protocol, participants, report);
    const bool isListed = participants < 2 || report.files.contains(testsTable);
    const auto corrections = correctionsIn(report.files[testsTable]);
    text += listOf("Corrections", {corrections.begin(), corrections.end()});
    text += listOf("Tests over participants, as analysis.R runs them in R", tests);
    if (tests.empty()) text += (isListed ? "none" : std::string{notListed}) + "\n";
    if (participants >= 4 && report.files.contains(testsTable)) { // two of each group
        takeTwoGroups(trials.value, participants);
        auto grouped = studyReport(trials.value, script);
        for (std::string& test : grouped.tests) test.insert(0, groupedMark.substr(2));
        if (const auto& of = grouped.tests; !of.empty())
            text += listOf("In their place, by group (two groups in people.csv)", of);
    }
    return PlannedStudy{std::move(text), std::move(report.files[analysisScriptName])};
}

Result<PlanFacts> readPlan(std::string_view plan, std::string_view name) {
    std::string_view rest = plan, first = takeUntil('\n', rest);
    const TrialHead head = trialHeadOf({std::string{first.substr(std::min<std::size_t>(1, first.size()))}});
    if (!head.contains("plan") || !head.contains("hash") || !head.contains("participants"))
        return Failure{std::string{name} + ":1: expected a plan of `physvib study plan`"};
    PlanFacts facts{head.at("hash"), head.at("participants"), {}, {}, plan.find(notListed) == plan.npos};
    while (!rest.empty()) {
        const std::string_view line = takeUntil('\n', rest);
        for (const auto& [mark, tests] : {std::pair{testMark, &facts.tests}, {groupedMark, &facts.grouped}})
            if (line.starts_with(mark)) tests->emplace_back(line.substr(mark.size()));
    }
    return facts;
}

} // namespace physvib
