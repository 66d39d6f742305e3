// SPDX-License-Identifier: MIT
// Combines trial files into one table, reads the facts of people, and finds unfinished sessions.
#include "Lab/Report/ReportTrials.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/StudyPlan.h"
#include "Lab/Study/StudyTasks.h"
#include <array>
#include <filesystem>
#include <iterator>
#include <set>
#include <tuple>

namespace physvib {
namespace {

std::string headValue(const TrialFile& file, const std::string& key) {
    const auto found = file.head.find(key);
    return found == file.head.end() ? std::string{} : found->second;
}

/// Columns without those that only newer files have.
std::vector<std::string> originalColumns(const CsvTable& table) {
    std::vector<std::string> columns = table.columns;
    std::erase_if(columns, [](const std::string& column) {
        return trialColumns::isMeasured(column) || trialColumns::isDelivery(column);
    });
    return columns;
}

/// All rows with the union of all columns; missing cells are empty.
CsvTable joinRows(const std::vector<TrialFile>& files) {
    CsvTable all{"the trials", {}, originalColumns(files.front().table), {}};
    for (const TrialFile& file : files)
        for (const std::string& column : file.table.columns)
            if (!all.column(column)) all.columns.push_back(column);
    for (const TrialFile& file : files)
        for (const CsvRow& row : file.table.rows) {
            CsvRow& wideRow = all.rows.emplace_back(CsvRow{row.line, {}});
            for (const std::string& column : all.columns) {
                const auto at = file.table.column(column);
                wideRow.cells.push_back(at ? row.cells[*at] : std::string{});
            }
        }
    return all;
}

void setProtocol(ReportTrials& trials, const std::optional<Protocol>& userProtocol) {
    const std::string name = trials.commonValue("protocol"), hash = trials.commonValue("hash");
    const auto fits = [&](const Protocol& protocol) {
        return protocol.name == name && protocolHash(protocol) == hash;
    };
    if (userProtocol) {
        if (fits(*userProtocol))
            trials.protocol = userProtocol;
        else
            trials.protocolNote = "the protocol that was given has another name or hash than these trials";
        return;
    }
    const auto& known = knownProtocols();
    if (const auto found = std::ranges::find_if(known, fits); found != known.end())
        trials.protocol = *found;
    else if (name.empty())
        trials.protocolNote = "the tables name no protocol";
    else
        trials.protocolNote =
            "protocol " + cleanLine(name) + " (hash " + cleanLine(hash) + ") is no built-in one (--protocol)";
}

/// True if all rows record their apparatus and none had noise.
bool wasWithoutNoise(const CsvTable& all) {
    const Cells cell{all};
    return !all.rows.empty() && std::ranges::all_of(all.rows, [&](const CsvRow& row) {
        return !cell(row, trialColumns::version).empty() &&
               cell(row, trialColumns::noiseDb) == trialColumns::noNoise;
    });
}

/// Returns an error for the first call that would write a file, since the page shows the calls to be
/// repeated; else an empty string.
std::string writingCallError(const CsvTable& table, const CallCheck& callError) {
    const auto column = table.column("render");
    for (const CsvRow& row : table.rows)
        if (column && callError && !callError(row.cells[*column]).empty())
            return table.cellError(row, *column, "calls that write no file");
    return {};
}

} // namespace

std::string ReportTrials::commonValue(const std::string& key) const {
    const std::string value = headValue(files.front(), key);
    return std::ranges::all_of(files, [&](const TrialFile& file) { return headValue(file, key) == value; })
               ? value
               : std::string{};
}

Result<ReportTrials> readReportTrials(const std::vector<std::pair<std::string, std::string>>& texts,
                                      const std::vector<ColumnName>& columns,
                                      const std::optional<Protocol>& protocol, const CallCheck& callError) {
    ReportTrials trials;
    SharedParticipants shared;
    for (const auto& [path, text] : texts) {
        auto table = readStudyTable(text, path, columns, trials.excluded);
        if (!table) return Failure{table.error};
        if (std::string error = writingCallError(table.value, callError); !error.empty())
            return Failure{std::move(error)};
        if (std::string error = shared.add(table.value); !error.empty()) return Failure{std::move(error)};
        TrialFile file{std::filesystem::path{path}.filename().string(),
                       parseTrialHead(table.value.comments),
                       std::move(table.value),
                       {}};
        if (!trials.files.empty()) {
            const TrialFile& first = trials.files.front();
            if (headValue(first, "protocol") != headValue(file, "protocol"))
                return Failure{path + ":1: expected trials of the protocol " +
                               inQuotes(headValue(first, "protocol")) + ", as in " + first.name + ", found " +
                               inQuotes(headValue(file, "protocol"))};
            if (originalColumns(first.table) != originalColumns(file.table))
                return Failure{path + ": expected the columns of " + first.name + ", found others"};
        }
        trials.isSimulated |= hasSimulatedAnswers(file.table);
        trials.files.push_back(std::move(file));
    }
    trials.all = joinRows(trials.files);
    const auto undelivered =
        std::stable_partition(trials.all.rows.begin(), trials.all.rows.end(),
                              [&](const CsvRow& row) { return !wasNotDelivered(trials.all, row); });
    trials.undelivered.assign(std::make_move_iterator(undelivered),
                              std::make_move_iterator(trials.all.rows.end()));
    trials.all.rows.erase(undelivered, trials.all.rows.end());
    if (trials.all.rows.empty())
        return Failure{texts.front().first + ": expected a trial that left as planned, found none: " +
                       undeliveredNote(trials.undelivered.size())};
    if (std::string note = shared.note(); !note.empty()) trials.notes.push_back(std::move(note));
    if (std::string note = trials.excluded.stimuliNote(); !note.empty())
        trials.notes.push_back(std::move(note));
    if (const auto& unused = trials.excluded.columns; !unused.empty())
        trials.notes.push_back("columns that --columns does not name: " + joinNames(unused, ", "));
    if (const auto kinds = analysesFor(trials.all);
        !trials.hasTasks() && !kinds.empty() && kinds.front() != "ratings") {
        std::set<std::string> scales;
        for (const std::string& column : trials.all.columns)
            if (!trialColumns::has(column)) scales.insert(column);
        if (!columns.empty() && !scales.empty())
            trials.notes.push_back("not analysed beside answers: " + joinNames(scales, ", "));
    }
    setProtocol(trials, protocol);
    return trials;
}

std::string applyFacts(ReportTrials& trials, StudyFacts facts) {
    trials.facts = std::move(facts);
    const auto participant = trials.all.column("participant");
    if (!trials.facts.noise.empty() && wasWithoutNoise(trials.all))
        return trials.files.front().name + ": --noise: expected trials with pink noise, found none";
    if (trials.facts.people.empty()) return {};
    if (!participant)
        return trials.files.front().name + ": --people: expected a column participant, found none";
    for (auto* const rows : {&trials.all.rows, &trials.undelivered})
        std::erase_if(*rows,
                      [&](const CsvRow& row) { return trials.facts.isExcluded(row.cells[*participant]); });
    const auto& people = trials.facts.people;
    if (!trials.all.column(trialColumns::group) &&
        std::ranges::any_of(people, [](const auto& person) { return !person.group.empty(); })) {
        trials.all.columns.emplace_back(trialColumns::group);
        for (CsvRow& row : trials.all.rows)
            row.cells.push_back(trials.facts.person(row.cells[*participant]).group);
    }
    return trials.all.rows.empty() ? trials.files.front().name +
                                         ": --people: expected a participant who is not excluded, found none"
                                   : std::string{};
}

std::string trialsCsv(const ReportTrials& trials, const std::string& firstLine) {
    std::string text = firstLine;
    text += csvLine(trials.all.columns);
    std::map<std::string, std::string> offered; // answers to one stimulus, which stand in no row
    for (const SessionPlan& session : trials.sessions())
        if (!session.answers.empty()) offered[session.name] = joinNames(session.answers, "|");
    const Cells cell{trials.all};
    const auto parts = trials.all.column("parts");
    for (const CsvRow& row : trials.all.rows) {
        if (answerKindOf(cell(row, trialColumns::task)) == AnswerKind::request) continue;
        auto cells = row.cells;
        if (const auto found = offered.find(cell(row, "session")); parts && found != offered.end())
            cells[*parts] = found->second;
        text += csvLine(cells);
    }
    return text;
}

// Reads the table of participants. Unknown columns are errors, so that no fact is silently ignored.

namespace {

constexpr std::array<std::string_view, 6> peopleColumns{"participant", "age",   "sex",
                                                        "handedness",  "group", "excluded"};
constexpr double maxAgeYears = 130.0;

} // namespace

Result<std::vector<ParticipantFacts>> readParticipantFacts(std::string_view text, std::string_view name) {
    auto read = readCsvTable(text, name, CsvHeader::named);
    if (!read) return Failure{read.error};
    const CsvTable& table = read.value;
    for (const std::string& column : table.columns)
        if (std::ranges::find(peopleColumns, column) == peopleColumns.end())
            return Failure{table.name + ": expected the columns " + nameList(peopleColumns) + ", found " +
                           inQuotes(column)};
    if (!table.column("participant"))
        return Failure{table.name + ": expected a column participant, found none"};
    std::vector<ParticipantFacts> people;
    std::set<std::string> codes;
    for (const CsvRow& row : table.rows) {
        const auto cell = [&](std::string_view column) {
            const auto at = table.column(column);
            return at && !ExcludedRows{}.isMissingAnswer(column, row.cells[*at]) ? row.cells[*at]
                                                                                 : std::string{};
        };
        ParticipantFacts facts{cell("participant"), {},           cell("sex"), cell("handedness"),
                               cell("excluded"),    cell("group")};
        if (facts.participant.empty() || !codes.insert(facts.participant).second)
            return Failure{
                table.cellError(row, *table.column("participant"), "a code of its own for each participant")};
        if (const std::string age = cell("age"); !age.empty()) {
            facts.ageYears = parseNumber<double>(age);
            if (!facts.ageYears || *facts.ageYears < 0.0 || *facts.ageYears > maxAgeYears)
                return Failure{table.cellError(row, *table.column("age"), "years from 0 to 130")};
        }
        people.push_back(std::move(facts));
    }
    return people;
}

// Counts the rows of every planned session, and replays adaptive ones.

namespace {

/// The answer of one row of a run, and the index of its staircase.
struct RunAnswer {
    bool isCorrect = false;
    std::size_t staircase = 0;
    bool timedOut = false; ///< moves no level
};
using Answers = std::vector<RunAnswer>;
using RunKey = std::tuple<std::string, std::string, std::string>; // participant, condition, session

bool isUnfinished(const SessionPlan& plan, const Answers& answers, std::size_t planned,
                  std::string& earlyEnd) {
    if (plan.untilCorrect > 0) { // ends after so many consecutive correct answers
        const auto wrong = std::ranges::find(answers.rbegin(), answers.rend(), false, &RunAnswer::isCorrect);
        if (wrong - answers.rbegin() >= plan.untilCorrect) return false;
    }
    if (!plan.adaptedAlternative()) return answers.size() < planned;
    AdaptiveLevel level{plan};
    for (const RunAnswer& answer : answers) {
        if (answer.timedOut) continue;
        level.selectStaircase(answer.staircase);
        level.answer(answer.isCorrect);
    }
    earlyEnd = level.earlyEnd();
    return !level.isDone();
}

} // namespace

bool hasAdaptiveRows(const ReportTrials& trials) {
    const Cells cell{trials.all};
    return trials.hasTasks() && std::ranges::any_of(trials.all.rows, [&](const CsvRow& row) {
               return cell(row, trialColumns::phase) != trialColumns::training &&
                      answerKindOf(cell(row, trialColumns::task)) == AnswerKind::choice &&
                      !cell(row, "correct").empty() && !cell(row, "level_db").empty();
           });
}

std::vector<UnfinishedRun> unfinishedRuns(const ReportTrials& trials) {
    const Cells cell{trials.all};
    if (!trials.protocol || !cell.has("participant") || !cell.has("session") || !cell.has("correct"))
        return {};
    std::map<RunKey, Answers> runs;
    std::vector<std::string> people;
    std::map<RunKey, std::set<int>> numbers;
    const auto makeKey = [&](const CsvRow& row) {
        return RunKey{cell(row, "participant"), cell(row, "condition"), cell(row, "session")};
    };
    const auto addNumber = [&](const CsvRow& row) {
        numbers[makeKey(row)].insert(parseNumber<int>(cell(row, "trial")).value_or(1));
    };
    for (const CsvRow& row : trials.all.rows) {
        const std::string& code = cell(row, "participant");
        addNumber(row);
        if (std::ranges::find(people, code) == people.end()) people.push_back(code);
        const auto staircase = parseNumber<std::size_t>(cell(row, trialColumns::staircase));
        runs[makeKey(row)].push_back({cell(row, "correct") == "1", staircase.value_or(1) - 1,
                                      cell(row, trialColumns::timedOut) == "1"});
    }
    std::map<RunKey, std::size_t> undelivered; // answered, but not delivered as planned
    for (const CsvRow& row : trials.undelivered) ++undelivered[makeKey(row)], addNumber(row);
    const auto missingTrials = [&](const RunKey& run, int count) { // `count`: planned trials, 0 if not known
        std::string words;
        int next = 1;
        std::set<int>& present = numbers[run];
        if (count > 0 && !present.empty() && *present.rbegin() > std::ssize(present))
            present.insert(count + 1);
        for (const int number : present) {
            if (number > next)
                words += (words.empty() ? "" : ", ") + std::to_string(next) +
                         (number > next + 1 ? " to " + std::to_string(number - 1) : "");
            next = number + 1;
        }
        return words.empty() ? words : (words.find(' ') == words.npos ? "trial " : "trials ") + words;
    };
    std::vector<UnfinishedRun> unfinished;
    for (const std::string& code : people)
        for (const ConditionPlan& condition : trials.protocol->conditions)
            for (const SessionPlan& plan : trials.protocol->sessions) {
                if (plan.answerKind() == AnswerKind::request) continue;
                const RunKey key{code, condition.name, plan.name};
                const Answers& answers = runs[key];
                const std::size_t plannedCount =
                    static_cast<std::size_t>(maxSessionTrials(plan, conditionStimuli(condition).size()));
                std::string earlyEnd;
                const bool isComplete = !isUnfinished(
                    plan, answers, plannedCount - std::min(plannedCount, undelivered[key]), earlyEnd);
                const bool hasFixedCount = plan.adaptedAlternative() == nullptr && plan.untilCorrect == 0;
                UnfinishedRun run{code,
                                  condition.name,
                                  plan.name,
                                  answers.size(),
                                  plannedCount,
                                  plan.adaptedAlternative() != nullptr,
                                  missingTrials(key, hasFixedCount ? static_cast<int>(plannedCount) : 0),
                                  isComplete,
                                  plan.isTraining,
                                  hasFixedCount};
                if (!isComplete || !run.missing.empty()) unfinished.push_back(run);
                run.earlyEnd = earlyEnd;
                if (isComplete && !earlyEnd.empty() && !plan.isTraining) unfinished.push_back(std::move(run));
            }
    return unfinished;
}

} // namespace physvib
