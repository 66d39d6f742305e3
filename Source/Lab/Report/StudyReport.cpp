// SPDX-License-Identifier: MIT
// Composes a report from the sections that fit its trials; a plan is the report of simulated people.
#include "Lab/Report/StudyReport.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Provenance.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NameList.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Files/TrialLog.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/BidsDataset.h"
#include "Lab/Report/ProtocolWords.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/SimulatedObserver.h"
#include "Lab/Study/StudyTasks.h"
#include <algorithm>
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
    if (trials.protocol)
        for (const SessionPlan& session : trials.protocol->sessions)
            if (session.points > 0)
                scales.insert(scales.end(), session.scores().begin(), session.scores().end());
    return scales;
}

/// What analysis.R finds, if it can be run here, and how else to run it.
void tellTests(ReportBuilder& report, StudyReport& made, const ScriptRunner& run) {
    report.page.heading("Tests");
    report.page.paragraph(
        "analysis.R, beside this page, chooses each test by its measure and by the factors that rows "
        "have, and runs it in R (Debian: r-base-core; r-cran-lme4 where people lack levels). The unit "
        "is the participant. Training, and trials that did not leave, are left out. Corrections are "
        "named with their p; sphericity and normality are shown, and decide nothing.");
    StudyFiles files = report.tables();
    files[analysisScriptName] = made.files[analysisScriptName];
    auto ran = run ? run(files) : Result<StudyFiles>{StudyFiles{}};
    if (!ran) {
        made.scriptFault = "analysis.R did not end: " + ran.error;
        return report.page.note(made.scriptFault);
    }
    if (ran.value.empty())
        return report.page.paragraph("It has not run: type `Rscript analysis.R` in this folder.");
    const std::string table = ran.value[testsTable];
    made.tests = testsIn(table);
    report.page.paragraph("By " + table.substr(std::min<std::size_t>(2, table.size()), table.find('\n') - 2) +
                          (made.tests.empty() ? ": no test was made." : ":"));
    report.page.lines(ran.value[testsWords]);
    ran.value.erase(testsWords);
    std::vector<std::string> tables;
    for (const auto& [name, text] : ran.value) tables.push_back(name);
    report.page.paragraph("Tables by R: " + joined(tables, ", ") + ".");
    made.files.merge(ran.value);
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
        made.notes.emplace_back(
            "no means are known of these columns: the report has their table, the participants, and what "
            "analysis.R tests");
        report.page.heading("Results");
        report.page.note(made.notes.back());
        report.page.table(report.tableText(trialsTable), trialsTable);
    }
    if (report.people() > 1) {
        made.files[analysisScriptName] = analysisScript(studyWords(trials), report.scales, inPoints(trials),
                                                        report.half, trials.protocol.has_value());
        tellTests(report, made, script);
    }
    if (!trials.facts.plan.empty()) {
        report.page.heading("Planned and done");
        const auto tests =
            report.people() < 2 || made.files.contains(testsTable) ? std::optional{made.tests} : std::nullopt;
        const auto compared = comparedWithPlan(trials.facts.plan, "plan", trials, tests);
        report.page.list(compared.value);
        if (made.files.contains(testsTable))
            if (const auto lines = notMadeIn(made.files.at(testsTable)); !lines.empty())
                report.page.list(lines);
    }
    tellProvenance(report);
    made.functions = report.functions;
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
    if (trials.protocol)
        for (const SessionPlan& session : trials.protocol->sessions)
            for (const auto& scale : session.scores()) words.columns[scale] = scoreWords(session, scale);
    for (const char* key : {"hash", "seed", "version"})
        if (const std::string value = trials.common(key); !value.empty()) words.source[key] = value;
    for (auto& [name, text] : bidsDataset(trials.all, words)) report.files["bids/" + name] = std::move(text);
}

Result<std::vector<std::pair<std::string, std::string>>> readTexts(const std::vector<std::string>& paths) {
    std::vector<std::pair<std::string, std::string>> texts;
    for (const std::string& path : paths) {
        auto text = readFile(path, limits::maxTableBytes);
        if (!text) return Failure{text.error};
        texts.emplace_back(path, std::move(text.value));
    }
    return texts;
}

} // namespace

Result<StudyReport> makeReport(const ReportJob& job, const std::optional<Protocol>& protocol,
                               const CallCheck& callFault, const ScriptRunner& script) {
    const auto texts = readTexts(job.files);
    if (!texts) return Failure{texts.error};
    auto trials = readReportTrials(texts.value, job.columns, protocol, callFault);
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
        if (const auto read = comparedWithPlan(plan.value, job.planPath, trials.value, {}); !read)
            return Failure{read.error};
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

Result<ReportTrials> simulatedTrials(const Protocol& protocol, int participants) {
    std::vector<std::pair<std::string, std::string>> files;
    for (int number = 1; number <= std::min(participants, mostSimulated); ++number)
        files.emplace_back(codeOf(number), simulatedFile(protocol, number));
    return readReportTrials(files, {}, protocol);
}

/// As a table of people does that names two groups.
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

/// Without its factors: a group adds one, and between people has a test of its own name.
std::string stemOf(std::string test) {
    constexpr std::string_view also = " and Kruskal and Wallis'";
    if (const auto at = test.find(also); at != test.npos) test.erase(at, also.size());
    return test.substr(0, test.rfind(" by "));
}

} // namespace

Result<PlannedStudy> plannedStudy(const Protocol& protocol, int participants, const ScriptRunner& script) {
    auto trials = simulatedTrials(protocol, participants);
    if (!trials) return Failure{trials.error};
    auto report = studyReport(trials.value, script);
    if (!report.scriptFault.empty()) return Failure{report.scriptFault};
    std::vector<std::string> conditions, sessions, tests;
    for (const std::string& test : report.tests) tests.push_back("test: " + test);
    for (const auto& one : protocol.conditions) conditions.push_back(conditionWords(one));
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
    const auto has = [&](auto is) {
        return std::ranges::any_of(protocol.sessions, [&](const auto& s) { return !s.isTraining && is(s); });
    };
    const bool isListed = participants < 2 || report.files.contains(testsTable);
    const auto lists = [&](std::string_view words) { // or may have it, where R was not there
        return !isListed || std::ranges::any_of(tests, [=](const std::string& test) {
            return test.find(words) != test.npos;
        });
    };
    const bool hasAnova = lists("analysis of variance"), hasPairs = lists("pairs by");
    std::vector<std::string> exclusions{
        "all trials of those for whom the table of people has a reason",
        std::string{"trials that did not leave as planned"} +
            (has([](const SessionPlan& s) { return s.answerSeconds > 0.0; }) ? ", ran out of time" : "") +
            " or have no answer",
        "who did not finish is named"};
    if (hasAnova || hasPairs)
        exclusions.push_back(
            std::string{"tests leave out who lacks a combination of levels; "} +
            (hasAnova ? "where somebody does, an analysis of variance also has a mixed model of all "
                        "(r-cran-lme4); "
                      : "") +
            "no factor is tested of which fewer than half of the people have all levels");
    std::vector<std::string> measures;
    if (has([](const SessionPlan& s) { return s.staircase.has_value(); }))
        measures.emplace_back(staircaseThresholds);
    if (has([](const SessionPlan& s) { return s.quest.has_value(); }) && participants > 1)
        measures.emplace_back(questThresholds);
    const bool hasFunctions = report.files.contains("psychometric-stimuli.csv");
    if (hasFunctions)
        measures.emplace_back(
            "thresholds (of two answers points of subjective equality) and JNDs of each "
            "participant's logistic function, by maximum likelihood: its level half way up, and "
            "half of what lies between a quarter and three quarters; functions are " +
            report.functions);
    if (has([](const SessionPlan& s) { return s.adjustment.has_value(); }))
        measures.emplace_back("matched levels: each participant's mean of what they set, in dB");
    if (has([](const SessionPlan& s) { return s.answer() == AnswerKind::number; }))
        measures.emplace_back("magnitudes: geometric means of each participant; exponents of each one's "
                              "power law of stimuli that are numbers, by least squares of logarithms");
    if (has([](const SessionPlan& s) { return s.comparesPairs; }))
        measures.emplace_back(
            "pairs of stimuli: means over participants of each one's mean of a pair, and a map of them by "
            "classical scaling (similarity.csv, mds.csv): scales whose names begin with dis or diff are "
            "distances, others what they lack of 100, of points of their number");
    for (const auto& [kind, words] : std::initializer_list<std::pair<AnswerKind, const char*>>{
             {AnswerKind::label,
              "percent correct: each participant's share of right answers; information transfer of "
              "all trials together, from 5 trials per cell on less Miller's bias"},
             {AnswerKind::place,
              "places: each participant's means of what they answered, by axis, and the standard "
              "deviation around them (variable error)"},
             {AnswerKind::choice, "choices: each participant's share of an alternative"},
             {AnswerKind::scores, "scales: each participant's mean of each"}})
        if (has([&](const SessionPlan& s) { return s.answer() == kind && !s.adaptedAlternative(); }))
            measures.emplace_back(words);
    if (!measures.empty()) text += listOf("Measures", measures);
    if (has([](const SessionPlan& s) { return s.adaptedAlternative() != nullptr; }))
        exclusions.emplace_back(
            "thresholds of sessions that were not finished, of staircases of fewer than two "
            "reversals, or at an end of the levels (half or more of a staircase's trials or of "
            "the reversals that count; of QUEST+ within half a step)");
    if (hasFunctions)
        exclusions.emplace_back(
            "functions of levels that are numbers: of answers that do not rise, that a constant "
            "fits as well (likelihood ratio, p > 0.05), of widths of 20 times the range of the "
            "levels, of thresholds outside it; of steps the JND");
    text += listOf("Exclusions", exclusions);
    std::vector<std::string> corrections;
    if (hasAnova)
        corrections.emplace_back("of factors of more than two levels within people Greenhouse and Geisser's, "
                                 "in an analysis of variance");
    if (hasPairs)
        corrections.push_back(std::string{"of the pairs of a factor "} +
                              (protocol.name.ends_with(thesisSuffix) ? "Bonferroni's" : "Holm's"));
    if (lists("against chance"))
        corrections.emplace_back("of shares against chance Holm's, over the lines of each session");
    std::set<std::string> scales;
    for (const SessionPlan& session : protocol.sessions)
        if (!session.isTraining && session.answer() == AnswerKind::scores)
            scales.insert(session.scales.begin(), session.scales.end());
    if (scales.size() > 1 && (hasAnova || hasPairs))
        corrections.emplace_back("of an effect over several scales Holm's");
    if (has([](const SessionPlan& s) {
            return s.answer() == AnswerKind::choice && std::max(s.alternatives.size(), s.answers.size()) > 2;
        }) &&
        lists("choice="))
        corrections.emplace_back(
            "of an effect, and of all pairs of a factor, over more than two alternatives Holm's");
    corrections.emplace_back(corrections.empty() ? "none"
                                                 : "over those tests that can be made: what cannot be tested "
                                                   "is named, and counts in none");
    text += listOf("Corrections", corrections);
    text += listOf("Tests over participants, as analysis.R runs them in R", tests);
    if (tests.empty()) text += (isListed ? "none" : std::string{notListed}) + "\n";
    if (participants >= 4 && report.files.contains(testsTable)) { // two of each group
        takeTwoGroups(trials.value, participants);
        auto grouped = studyReport(trials.value, script);
        for (std::string& test : grouped.tests) test.insert(0, groupedMark.substr(2));
        if (const auto& of = grouped.tests; !of.empty())
            text += listOf(
                "In their place, if people.csv names groups (here two, of two people or more each)", of);
    }
    return PlannedStudy{std::move(text), std::move(report.files[analysisScriptName])};
}

Result<std::vector<std::string>> comparedWithPlan(std::string_view plan, std::string_view name,
                                                  const ReportTrials& trials,
                                                  const std::optional<std::vector<std::string>>& tests) {
    std::string_view rest = plan, first = takeUntil('\n', rest);
    const TrialHead head = trialHeadOf({std::string{first.substr(std::min<std::size_t>(1, first.size()))}});
    if (!head.contains("plan") || !head.contains("hash") || !head.contains("participants"))
        return Failure{std::string{name} + ":1: expected a plan of `physvib study plan`"};
    std::set<std::string> planned;
    const auto mark = trials.all.column(trialColumns::group) && plan.find(groupedMark) != plan.npos
                          ? groupedMark
                          : testMark;
    while (!rest.empty()) {
        const std::string_view line = takeUntil('\n', rest);
        if (line.starts_with(mark)) planned.emplace(line.substr(mark.size()));
    }
    const bool isOfThis = head.at("hash") == trials.common("hash");
    std::vector<std::string> sentences{
        "The plan, whose hash is " + contentHash(std::string{plan}) +
        (isOfThis ? ", is of the protocol of these trials (hash " + head.at("hash") + ")."
                  : ", is of another protocol than these trials: hash " + head.at("hash") + ", theirs " +
                        (trials.common("hash").empty() ? "is not one" : trials.common("hash")) + ".")};
    std::set<std::string> people;
    for (const TrialFile& file : trials.files)
        if (const auto column = file.table.column("participant"))
            for (const CsvRow& row : file.table.rows) people.insert(row.cells[*column]);
    if (std::to_string(people.size()) != head.at("participants"))
        sentences.push_back("Planned were " + head.at("participants") + " participants, " +
                            std::to_string(people.size()) + " took part.");
    if (!tests || plan.find(notListed) != std::string_view::npos) {
        sentences.emplace_back("The tests are not compared: R did not run, now or when it was planned; the "
                               "scripts can be.");
        return sentences;
    }
    if (tests->empty() && planned.empty()) {
        sentences.emplace_back(
            (sentences.size() > 1 ? "Plan" : "The number of participants is as planned; plan") +
            std::string{" and report make no test."});
        return sentences;
    }
    for (const std::string& test : *tests) {
        if (planned.erase(test) > 0) continue;
        const auto other = std::ranges::find_if(planned, [&](const auto& one) {
            return stemOf(one) == stemOf(test) && std::ranges::find(*tests, one) == tests->end();
        });
        sentences.push_back(other == planned.end() ? "Not planned: " + test
                                                   : "Planned as " + *other + ", done as " + test);
        if (other != planned.end()) planned.erase(other);
    }
    for (const std::string& test : planned) sentences.push_back("Planned, not done: " + test);
    if (sentences.size() == 1)
        sentences.emplace_back("The number of participants and the titles of tests are as planned.");
    return sentences;
}

} // namespace physvib
