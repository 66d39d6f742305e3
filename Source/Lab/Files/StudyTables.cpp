// SPDX-License-Identifier: MIT
// Maps the columns of other programs' tables to ours, and finds participants who are in several tables.
#include "Lab/Files/StudyTables.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Lab/Study/Identification.h"
#include <iterator>
#include <sstream>

namespace physvib {
namespace {

template <class Words>
bool contains(const Words& words, std::string_view cell) {
    return std::ranges::find(words, cell) != std::end(words);
}

constexpr std::string_view trainingNames[] = {"practice", "Practice", "practise", "train",   "Training",
                                              "warmup",   "warm-up",  "warm up",  "training"};

/// Splits "touch_x:0:1230". A name with another ending is a plain column name.
ColumnName parseColumn(std::string ours, std::string words) {
    const std::size_t second = words.rfind(':'), first = second == std::string::npos || second == 0
                                                             ? std::string::npos
                                                             : words.rfind(':', second - 1);
    if (first == std::string::npos || first == 0) return {std::move(ours), std::move(words)};
    const auto from = parseNumber<double>(words.substr(first + 1, second - first - 1)),
               to = parseNumber<double>(words.substr(second + 1));
    if (!from || !to || *from == *to) return {std::move(ours), std::move(words)};
    return {std::move(ours), words.substr(0, first), std::pair{*from, *to}};
}

/// Converts a column to shares of its range. Returns an error for the first cell that is no number, or "".
std::string convertToShares(CsvTable& table, std::size_t column, const std::pair<double, double>& range) {
    for (CsvRow& row : table.rows) {
        const auto number = parseNumber<double>(row.cells[column]);
        if (!number) return table.cellError(row, column, "a number");
        row.cells[column] = numberText((*number - range.first) / (range.second - range.first));
    }
    return {};
}

/// Also numbers the true places along one axis as grid lines, if there are few enough of them. Returns an
/// error or an empty string.
std::string numberLines(CsvTable& table, std::string_view places, const char* lines) {
    const auto column = table.column(places);
    if (!column || table.column(lines)) return {};
    std::set<double> values;
    for (const CsvRow& row : table.rows) {
        const auto place = parseNumber<double>(row.cells[*column]);
        if (!place) return table.cellError(row, *column, "a number");
        values.insert(*place);
    }
    if (values.size() > maxGridLines) return {};
    table.columns.emplace_back(lines);
    for (CsvRow& row : table.rows)
        row.cells.push_back(std::to_string(
            1 + std::distance(values.begin(), values.find(*parseNumber<double>(row.cells[*column])))));
    return {};
}

bool isUtf8(std::string_view text) noexcept {
    while (!text.empty()) {
        const std::size_t bytes = firstCharacter(text).bytes;
        if (bytes == 0) return false;
        text.remove_prefix(bytes);
    }
    return true;
}

constexpr std::string_view trueWords[] = {"true", "TRUE", "True", "1", "1.0"}; // in tables of other programs

void normaliseForeignCells(CsvTable& table, const ExcludedRows& excluded) {
    if (!parseTrialHead(table.comments).empty()) return;
    constexpr std::string_view falseWords[] = {"false", "FALSE", "False", "0.0"};
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        for (CsvRow& row : table.rows) {
            std::string& cell = row.cells[c];
            if (excluded.isMissingAnswer(table.columns[c], cell)) cell.clear();
            if (table.columns[c] == trialColumns::phase && contains(trainingNames, cell))
                cell = trialColumns::training;
            if (table.columns[c] != "correct" && table.columns[c] != trialColumns::timedOut) continue;
            if (contains(trueWords, cell)) cell.assign(1, '1');
            if (contains(falseWords, cell)) cell.assign(1, '0');
        }
}

/// Error if a trial has two rows: in our files, and in other programs' tables with a column of trials.
std::string duplicateRowError(const CsvTable& table, bool isNamed) {
    const bool isOurs = parseTrialHead(table.comments).contains("protocol");
    std::vector<std::size_t> columns;
    for (const char* name : {"participant", "condition", "session", "phase", "trial"})
        if (const auto column = table.column(name)) columns.push_back(*column);
    if (!(isOurs || isNamed) || !table.column("participant") || !table.column("trial")) return {};
    std::map<std::vector<std::string>, std::size_t> lines;
    for (const CsvRow& row : table.rows) {
        std::vector<std::string> key;
        for (const std::size_t c : columns) key.push_back(row.cells[c]);
        if (key.back().empty()) continue;
        const auto [first, isNew] = lines.try_emplace(std::move(key), row.line);
        if (!isNew)
            return table.cellError(row, columns.back(),
                                   "each trial once, not as in line " + std::to_string(first->second));
    }
    return {};
}

/// Error if two rows of another program's table are equal, also in a time to the thousandth. Only if most
/// rows differ in their other cells: otherwise equal answers are possible.
std::string similarRowError(const CsvTable& table) {
    if (!parseTrialHead(table.comments).empty()) return {};
    std::set<std::vector<std::string>> all, withoutTimes;
    std::string error;
    for (const CsvRow& row : table.rows) {
        const auto time = std::ranges::find_if(row.cells, [](const std::string& cell) {
            return cell.size() > 3 + std::min(cell.size(), cell.find('.')) && parseNumber<double>(cell);
        });
        if (time == row.cells.end()) continue;
        const auto c = static_cast<std::size_t>(time - row.cells.begin());
        if (!all.insert(row.cells).second) error = table.cellError(row, c, "each row once");
        auto cells = row.cells;
        cells[c].clear(), withoutTimes.insert(std::move(cells));
    }
    return 10 * withoutTimes.size() < 9 * all.size() ? std::string{} : error; // many equal answers
}

std::string selectColumns(CsvTable& table, std::span<const ColumnName> names, ExcludedRows& excluded) {
    if (names.empty()) return {};
    std::vector<std::size_t> sources;
    std::vector<std::string> columns;
    for (const ColumnName& name : names) {
        const auto found = table.column(name.theirs);
        if (!found) return table.name + ": expected a column " + cleanLine(name.theirs) + ", found none";
        sources.push_back(*found);
        columns.push_back(name.ours);
    }
    if (const auto observer = table.column(trialColumns::observer);
        observer && std::ranges::find(columns, trialColumns::observer) == columns.end()) {
        sources.push_back(*observer);
        columns.emplace_back(trialColumns::observer);
    }
    for (const std::string& column : table.columns)
        if (parseTrialHead(table.comments).empty() && !column.empty() &&
            std::ranges::find(names, column, &ColumnName::theirs) == names.end())
            excluded.columns.insert(column);
    const bool hasScales = !std::ranges::all_of(names, trialColumns::has, &ColumnName::ours);
    const auto participantAt = std::ranges::find(columns, "participant") - columns.begin();
    const auto phaseAt = std::ranges::find(columns, trialColumns::phase) - columns.begin();
    std::erase_if(table.rows, [&](const CsvRow& row) {
        bool isRated = !hasScales, isAnswered = true, isTrial = false, isComplete = true, hasTime = true;
        for (std::size_t c = 0; c < names.size(); ++c) {
            const std::string& ours = names[c].ours;
            const bool hasValue =
                !row.cells[sources[c]].empty() && !excluded.isMissingAnswer(ours, row.cells[sources[c]]);
            if (ours == trialColumns::timedOut)
                hasTime = !contains(trueWords, row.cells[sources[c]]);
            else if (!trialColumns::has(ours))
                isRated |= hasValue; // a value on one scale is enough
            else if (contains(answerColumns, ours))
                isAnswered &= hasValue;
            else if (ours != trialColumns::group) // rows without a group are kept
                isComplete &= hasValue, isTrial |= ours != "participant";
        }
        if (isComplete && ((isRated && isAnswered) || !hasTime)) return false;
        const auto cell = [&](std::ptrdiff_t at) {
            return at < std::ssize(columns) ? row.cells[sources[static_cast<std::size_t>(at)]]
                                            : std::string{};
        };
        const bool isUnanswered = isComplete && isTrial, isTraining = contains(trainingNames, cell(phaseAt));
        excluded.rowCount += !isUnanswered || !isTraining;
        if (!cell(participantAt).empty())
            excluded.unanswered[cell(participantAt)][isTraining] += isUnanswered;
        return true;
    });
    for (CsvRow& row : table.rows) {
        std::vector<std::string> cells;
        for (const std::size_t c : sources) cells.push_back(row.cells[c]);
        row.cells = std::move(cells);
    }
    table.columns = std::move(columns);
    if (table.rows.empty())
        return table.name + ": expected rows with something in every named column, found none";
    for (std::size_t c = 0; c < names.size(); ++c)
        if (names[c].range)
            if (std::string error = convertToShares(table, c, *names[c].range); !error.empty()) return error;
    if (std::string error = numberLines(table, "target_x", "target_column"); !error.empty()) return error;
    return numberLines(table, "target_y", "target_row");
}

} // namespace

bool ExcludedRows::isMissingAnswer(std::string_view column, const std::string& cell) const {
    constexpr std::string_view missingNames[] = {"null", "NaN", "nan", "NA", "n/a", ".", "None"},
                               codeColumns[] = {"participant", "observer", "condition", "session",
                                                "phase",       "task",     "stimulus",  "parts"};
    return contains(missingNames, cell) && !contains(codeColumns, column) &&
           !(column == trialColumns::group && cell == "None") &&
           !(column == "response" && stimuli.contains(cell));
}

std::string ExcludedRows::stimuliNote() const {
    return stimuli.empty()
               ? std::string{}
               : "stimuli are named " + joinNames(stimuli, ", ") +
                     ": that is an answer here, also where a program wrote it for none, unless you "
                     "name a column, such as correct, that is empty there";
}

Result<std::vector<ColumnName>> parseColumnNames(std::span<const std::string> words) {
    std::vector<ColumnName> names;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == word.size())
            return Failure{"expected NAME=COLUMN of the table, e.g. response=key_resp.keys, found " +
                           inQuotes(word)};
        names.push_back(parseColumn(word.substr(0, equals), word.substr(equals + 1)));
        if (std::ranges::count(names, names.back().ours, &ColumnName::ours) > 1)
            return Failure{"expected each name once, found " + inQuotes(names.back().ours) + " twice"};
    }
    return names;
}

std::string unitError(std::span<const ColumnName> names) {
    using Pair = std::pair<std::string, std::string>;
    for (const auto& [answered, truth] : {Pair{"x", "target_x"}, {"y", "target_y"}, {"x", "y"}}) {
        const auto answer = std::ranges::find(names, answered, &ColumnName::ours),
                   target = std::ranges::find(names, truth, &ColumnName::ours);
        if (answer != names.end() && target != names.end() &&
            answer->range.has_value() != target->range.has_value())
            return "--columns: expected a range of both " + answered + " and " + truth +
                   ", or of none of them, as they are compared";
    }
    return {};
}

Result<CsvTable> readStudyTable(std::string_view text, std::string_view name,
                                std::span<const ColumnName> names, ExcludedRows& excluded) {
    auto read = readCsvTable(text, name, names.empty() ? CsvHeader::named : CsvHeader::loose);
    if (!read) return read;
    CsvTable& table = read.value;
    if (!isUtf8(text))
        return Failure{table.name + ": expected UTF-8, found Latin-1 or the like: save it as CSV UTF-8"};
    if (std::string error = similarRowError(table); !error.empty()) return Failure{std::move(error)};
    const auto stimulus = std::ranges::find(names, "stimulus", &ColumnName::ours);
    if (const auto at = table.column(stimulus == names.end() ? "stimulus" : stimulus->theirs);
        at && parseTrialHead(table.comments).empty())
        for (const CsvRow& row : table.rows)
            if (excluded.isMissingAnswer("", row.cells[*at])) excluded.stimuli.insert(row.cells[*at]);
    if (std::string error = selectColumns(table, names, excluded); !error.empty())
        return Failure{std::move(error)};
    normaliseForeignCells(table, excluded);
    if (std::string error = duplicateRowError(table, !names.empty()); !error.empty())
        return Failure{std::move(error)};
    return read;
}

bool hasSimulatedAnswers(const CsvTable& table) {
    const auto contains = [](const std::string& text) {
        return text.find(trialColumns::simulated) != std::string::npos;
    };
    const auto observer = table.column(trialColumns::observer);
    return std::ranges::any_of(table.comments,
                               [&](const auto& line) {
                                   return line.find(" observer=") != std::string::npos && contains(line);
                               }) ||
           (observer && std::ranges::any_of(
                            table.rows, [&](const CsvRow& row) { return contains(row.cells[*observer]); }));
}

// Detects participants in several tables. A trial file has one person, so a second file of the same person is
// an error; other programs write one table per run.

namespace {

constexpr std::size_t maxListed = 6; // participants, and tables of one, that a message lists

std::string tableList(const std::vector<std::string>& names) {
    const std::string words = joinNames(std::span{names}.first(std::min(names.size(), maxListed)), ", ");
    return names.size() > maxListed ? words + " ..." : words;
}

} // namespace

TrialHead parseTrialHead(const std::vector<std::string>& comments) {
    TrialHead head;
    for (const std::string& line : comments) {
        std::istringstream words{line};
        std::string word;
        if (!(words >> word) || word != "physvib" || !(words >> head["version"])) continue;
        while (words >> word)
            if (const auto equals = word.find('='); equals != std::string::npos)
                head[word.substr(0, equals)] = word.substr(equals + 1);
        break;
    }
    return head;
}

std::string SharedParticipants::add(const CsvTable& table, const std::set<std::string>& participants) {
    const auto entries = parseTrialHead(table.comments);
    if (const auto code = entries.find("participant"), protocol = entries.find("protocol");
        code != entries.end() && protocol != entries.end()) {
        const auto [at, isNew] = trialFiles_.try_emplace({protocol->second, code->second}, table.name);
        if (!isNew)
            return table.name + ": expected trials of somebody else than " + at->second +
                   ", found participant " + cleanLine(code->second) +
                   " in both: leave one of them out; two people need two codes";
    }
    for (const std::string& participant : participants)
        if (!participant.empty()) tables_[participant].push_back(table.name);
    return {};
}

std::string SharedParticipants::add(const CsvTable& table, std::string_view column) {
    std::set<std::string> participants;
    std::string all;
    if (const auto at = table.column(column))
        for (const CsvRow& row : table.rows) {
            participants.insert(row.cells[*at]);
            for (const std::string& cell : row.cells) all.append(cell).push_back('\n');
        }
    const auto [earlier, isNew] = rows_.try_emplace(contentHash(all), table.name);
    if (!isNew && !all.empty() && parseTrialHead(table.comments).empty())
        return table.name + ": expected other rows than those of " + earlier->second + ", found the same";
    return add(table, participants);
}

std::string SharedParticipants::note() const {
    std::string words;
    std::size_t shared = 0;
    for (const auto& [participant, tables] : tables_) {
        if (tables.size() < 2 || ++shared > maxListed) continue;
        words += (shared > 1 ? "; " : "") + cleanLine(participant) + " in " + tableList(tables);
    }
    if (shared == 0) return {};
    if (shared > maxListed) words += "; and " + std::to_string(shared - maxListed) + " more";
    return "participants who are in several tables count as one person each; if they are not, give them "
           "different codes: " +
           words;
}

} // namespace physvib
