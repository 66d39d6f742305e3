// SPDX-License-Identifier: MIT
// Reads each kind of study table cell by cell; an invalid cell throws and becomes the reader's error.
#include "Lab/Files/StudyCsv.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/QuestMethod.h"
#include "Lab/Study/StimulusJob.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace physvib {
namespace {

using detail::StudyRows;
using detail::StudyTableError;

template <class Trial>
std::vector<Trial>& trialsOfGroup(const StudyRows& rows, StudyData<Trial>& data, const std::string& name) {
    const auto found = std::ranges::find(data.groups, name, &TrialGroup<Trial>::name);
    if (found != data.groups.end()) return found->trials;
    if (data.groups.size() == limits::maxConditions)
        throw StudyTableError{rows.table().name + ": expected at most " +
                              std::to_string(limits::maxConditions) + " conditions, found more"};
    data.groups.push_back({name, {}});
    return data.groups.back().trials;
}

/// Calls `addTrials(rows, data)` per file. Exceptions and files without a usable trial become a Failure.
template <class Data, class AddTrials>
Result<Data> readAll(std::span<const NamedText> files, AddTrials addTrials) {
    Data data;
    SharedParticipants shared;
    try {
        std::vector<StudyRows> tables;
        StudyRows::Sessions sessions;
        for (const NamedText& file : files)
            tables.emplace_back(file.text, file.name, file.columns).addSessions(sessions);
        for (StudyRows& rows : tables) {
            rows.separateSessions(sessions);
            if (auto error = shared.add(rows.table()); !error.empty())
                throw StudyTableError{std::move(error)};
            data.isSimulated |= hasSimulatedAnswers(rows.table());
            const std::size_t count = addTrials(rows, data);
            rows.addWarnings(data.warnings);
            if (count == 0)
                throw StudyTableError{rows.table().name + ": expected trials of this kind, found none"};
        }
    } catch (const StudyTableError& error) {
        return Failure{error.message};
    }
    if (std::string note = shared.note(); !note.empty()) data.warnings.push_back(std::move(note));
    return data;
}

/// Limits the number of labels, because a confusion matrix has a row and a column for each.
void checkLabelCount(const std::string& file, const StudyData<IdentificationTrial>& data) {
    std::set<std::string_view> labels;
    for (const auto& condition : data.groups)
        for (const auto& trial : condition.trials) {
            labels.insert(trial.stimulus);
            labels.insert(trial.response);
            if (labels.size() > limits::maxLabels)
                throw StudyTableError{file + ": expected at most " + std::to_string(limits::maxLabels) +
                                      " different stimuli and responses, found more"};
        }
}

/// Target columns of our own trial files: a grid cell, and the render call that contains the grid.
struct GridTargets {
    std::size_t row, column, call;

    static std::optional<GridTargets> findColumns(const StudyRows& rows) {
        const auto row = rows.findColumn("target_row"), column = rows.findColumn("target_column"),
                   call = rows.findColumn(trialColumns::render);
        if (rows.findColumn("target_x") || !row || !column || !call) return std::nullopt;
        return GridTargets{*row, *column, *call};
    }

    FieldPlace readPlace(const StudyRows& rows, const CsvRow& r) const {
        constexpr int maxLine = static_cast<int>(maxGridLines);
        const GridCell cell{rows.wholeNumber(r, row, 1, maxLine), rows.wholeNumber(r, column, 1, maxLine)};
        const auto grid = parseGrid(r.cells[call]);
        if (!grid || cell.row > grid->rows || cell.column > grid->columns)
            throw StudyTableError{
                rows.table().cellError(r, call, "a call with the --grid that the target is of")};
        return grid->place(cell);
    }
};

std::size_t addGridPlaces(const StudyRows& rows, const GridTargets& targets, StudyData<PlaceTrial>& data) {
    const auto x = rows.requireColumn("x"), y = rows.requireColumn("y");
    const std::string unit = "true places are those of the calls' grids, in shares of the field's width and "
                             "height, y downwards; a distance counts both shares alike";
    if (std::ranges::find(data.warnings, unit) == data.warnings.end()) data.warnings.push_back(unit);
    return rows.forEachRow(AnswerKind::place, [&](const CsvRow& row) {
        const FieldPlace truth = targets.readPlace(rows, row);
        trialsOfGroup(rows, data, rows.conditionOf(row))
            .push_back({rows.cellOrEmpty(row, "participant"), rows.cellOrEmpty(row, "stimulus"), truth.x,
                        truth.y, rows.number(row, x, 0.0, 1.0), rows.number(row, y, 0.0, 1.0)});
    });
}

constexpr char kindSeparator = '\n'; // occurs in no cell

/// Temporary name of a condition and stimulus, until nameGroups().
std::string conditionKey(const std::string& condition, const std::string& stimulus) {
    return condition + kindSeparator + stimulus;
}

/// Trials are told apart by condition or stimulus, or by words of both where both differ:
/// "condition=low stimulus=0.2".
template <class Trial>
void nameGroups(std::vector<Trial>& trials, std::string Trial::*kind,
                const std::string& none = "all trials") {
    std::set<std::string, std::less<>> conditions, stimuli;
    const auto parts = [](std::string_view rest) {
        const std::string_view condition = takeUntil(kindSeparator, rest);
        return std::pair{condition, rest};
    };
    for (const Trial& trial : trials) {
        const auto [condition, stimulus] = parts(trial.*kind);
        conditions.emplace(condition), stimuli.emplace(stimulus);
    }
    const auto words = [](const char* name, std::string_view cell) {
        return (cell.substr(0, cell.find(' ')).find('=') == cell.npos ? std::string{name} + "=" : "") +
               std::string{cell};
    };
    for (Trial& trial : trials) {
        const auto [condition, stimulus] = parts(trial.*kind);
        const bool isConditionEnough = stimulus.empty() || (conditions.size() > 1 && stimuli.size() == 1);
        trial.*kind = condition.empty() && stimulus.empty() ? none
                      : isConditionEnough                   ? std::string{condition}
                      : conditions.size() < 2
                          ? std::string{stimulus}
                          : words("condition", condition) + " " + words("stimulus", stimulus);
    }
}

/// True if another program's column is a fact of people, such as age: one value for each, but not for all.
bool isParticipantFact(const CsvTable& table, std::size_t column) {
    const auto participant = table.column("participant");
    if (!participant || table.column(trialColumns::task)) return false;
    std::map<std::string, std::set<std::string>> values;
    for (const CsvRow& row : table.rows) values[row.cells[*participant]].insert(row.cells[column]);
    const auto hasSameValues = [&](const auto& person) { return person.second == values.begin()->second; };
    return values.size() < table.rows.size() &&
           (values.size() == 1 || !std::ranges::all_of(values, hasSameValues)) &&
           std::ranges::all_of(values, [](const auto& person) { return person.second.size() == 1; });
}

std::vector<std::size_t> scaleColumns(const CsvTable& table, std::vector<std::string>& warnings) {
    std::vector<std::size_t> scales, factColumns;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        if (!trialColumns::has(table.columns[c]))
            (isParticipantFact(table, c) ? factColumns : scales).push_back(c);
    if (scales.empty()) return factColumns;
    for (const std::size_t c : factColumns)
        warnings.push_back(table.name + ": column " + cleanLine(table.columns[c]) +
                           " has one value of each participant: a fact of people, no scale");
    return scales;
}

std::size_t addRatings(const StudyRows& rows, RatingData& ratings) {
    const auto scales = scaleColumns(rows.table(), ratings.warnings);
    std::vector<std::string> names;
    for (const auto c : scales) names.push_back(rows.table().columns[c]);
    if (names.empty())
        throw StudyTableError{rows.table().name + ": expected a column per rating scale, found none"};
    if (!ratings.scales.empty() && ratings.scales != names)
        throw StudyTableError{rows.table().name + ": expected the scales of the files before"};
    ratings.scales = names;
    const auto& all = rows.table().rows;
    const auto groupName = [&](const CsvRow& row) { return rows.cellOrEmpty(row, trialColumns::group); };
    const bool hasGroups = std::ranges::any_of(all, [&](const auto&row) { return !groupName(row).empty(); }),
               hasOneStimulus = std::ranges::all_of(all, [&](const CsvRow&row) {
                   return rows.cellOrEmpty(row, "stimulus") == rows.cellOrEmpty(all.front(), "stimulus");
               });
    return rows.forEachRow(AnswerKind::scores, [&](const CsvRow& row) {
        RatingTrial trial{
            rows.cellOrEmpty(row, "participant"),
            conditionKey(rows.cellOrEmpty(row, "condition"),
                         hasGroups && hasOneStimulus ? std::string{} : rows.cellOrEmpty(row, "stimulus")),
            {}};
        if (hasGroups)
            trial.condition.append(trial.condition.ends_with(kindSeparator) ? "group=" : " group=")
                .append(groupName(row).empty() ? "not known" : groupName(row));
        for (const auto c : scales) // scales of other sessions have no answers here
            trial.scores.push_back(row.cells[c].empty() ? std::nan("") : rows.number(row, c, 0.0, 100.0));
        trialsOfGroup(rows, ratings, rows.sessionOf(row)).push_back(std::move(trial));
    });
}

/// A level trial, or nullopt if the row is of another kind.
std::optional<LevelTrial> levelTrial(const StudyRows& rows, const CsvRow& row) {
    const bool hasTasks = rows.findColumn(trialColumns::task).has_value();
    // tables of other programs have no task column and one kind of trial
    const std::optional<AnswerKind> answer = hasTasks
                                                 ? answerKindOf(rows.cellOrEmpty(row, trialColumns::task))
                                             : rows.findColumn("value") ? AnswerKind::number
                                                                        : AnswerKind::choice;
    if (answer != AnswerKind::level && answer != AnswerKind::number &&
        (answer != AnswerKind::choice || rows.cell(row, "correct").empty() ||
         (hasTasks && rows.cell(row, "level_db").empty())))
        return std::nullopt;
    LevelTrial trial{answer == AnswerKind::level    ? LevelTrial::Kind::adjustment
                     : answer == AnswerKind::number ? LevelTrial::Kind::magnitude
                                                    : LevelTrial::Kind::staircase,
                     rows.cellOrEmpty(row, "participant"), rows.conditionOf(row),
                     rows.cellOrEmpty(row, rows.findColumn("stimulus") ? "stimulus" : "level_db")};
    if (trial.kind != LevelTrial::Kind::staircase) {
        trial.value =
            rows.number(row, "value", trial.kind == LevelTrial::Kind::magnitude ? minEstimate : -maxEstimate,
                        maxEstimate);
        return trial;
    }
    trial.levelDb = rows.number(row, "level_db", -1000.0, 1000.0);
    trial.session = rows.cellOrEmpty(row, "session");
    if (const auto mixed = rows.cellOrEmpty(row, trialColumns::staircase); !mixed.empty())
        trial.session += "/" + mixed; // each mixed staircase is a run of its own
    trial.value = rows.cell(row, "correct") == "1" ? 1.0 : 0.0;
    trial.quest = rows.cellOrEmpty(row, trialColumns::quest);
    if (trial.quest.empty()) return trial;
    if (!questPlan(trial.quest))
        throw StudyTableError{rows.table().cellError(row, rows.requireColumn(trialColumns::quest),
                                                     "the words of a QUEST+ session")};
    trial.kind = LevelTrial::Kind::quest;
    trial.value = rows.wholeNumber(row, "correct", 0, 1);
    return trial;
}

std::size_t addLevelTrials(const StudyRows& rows, StudyData<LevelTrial>& data) {
    std::size_t count = 0, trainingTrials = 0, zeroCount = 0;
    std::set<std::string> participants;
    const bool hasTasks = rows.findColumn(trialColumns::task).has_value(),
               hasValues = rows.findColumn("value").has_value();
    if (!hasTasks && !hasValues) rows.requireColumn("correct");
    const auto isTraining = [&](const CsvRow& row) {
        return rows.cellOrEmpty(row, trialColumns::phase) == trialColumns::training;
    };
    const auto answerKind = [&](const CsvRow& row) {
        return answerKindOf(rows.cellOrEmpty(row, trialColumns::task));
    };
    // If all adjustments are in trainings, they set the levels of the study, and are read.
    const bool hasMatches = std::ranges::any_of(rows.table().rows, [&](const CsvRow& row) {
        return answerKind(row) == AnswerKind::level && !isTraining(row);
    });
    for (const CsvRow& row : rows.table().rows) {
        const auto answer = answerKind(row);
        if (isTraining(row) && (answer != AnswerKind::level || hasMatches)) continue;
        if (answer == AnswerKind::request) continue; // explorations have no stimulus
        if (hasTasks ? answer == AnswerKind::number : hasValues) {
            const std::string& value = rows.cell(row, "value");
            const bool isZero = parseNumber<double>(value) == 0.0;
            if (zeroCount += isZero; isZero) {
                const std::string code = cleanLine(rows.cellOrEmpty(row, "participant"));
                participants.insert(code.empty() ? code
                                                 : nameInSession(code, cleanLine(rows.conditionOf(row))));
            }
            if (isZero || value.empty()) continue;
        }
        if (auto trial = levelTrial(rows, row)) {
            ++count;
            trainingTrials += isTraining(row);
            trialsOfGroup(rows, data, {}).push_back(std::move(*trial));
        }
    }
    if (trainingTrials > 0)
        data.warnings.emplace_back("levels were set in a training, and no others: it counts");
    if (count > 0 && !rows.findColumn("stimulus") && rows.findColumn("level_db") && hasValues)
        data.warnings.push_back(rows.table().name + " has no column stimulus: level_db (dB) stands for it");
    if (zeroCount > 0)
        data.warnings.push_back(plural(zeroCount, "magnitude") + " of 0, which has no logarithm, left out" +
                                (participants.contains("") ? "" : ": of " + joinNames(participants, ", ")));
    return count;
}

/// Where a table's levels are: a column of that name, or `name=level` in the words of condition or stimulus.
struct LevelSource {
    std::size_t column = 0;
    std::string prefix{}; ///< "level_g="; empty: the whole cell
    std::optional<std::size_t> secondColumn{};

    static std::optional<LevelSource> findColumns(const CsvTable& table, const std::string& name) {
        if (const auto column = table.column(name)) return LevelSource{*column};
        const auto condition = table.column("condition"), stimulus = table.column("stimulus");
        if (!condition && !stimulus) return std::nullopt;
        return LevelSource{condition.value_or(stimulus.value_or(0)), name + "=", stimulus};
    }
    std::string_view level(const CsvRow& row) const {
        if (prefix.empty()) return row.cells[column];
        const std::string_view found = findLevelWord(row.cells[column]);
        return found.empty() && secondColumn ? findLevelWord(row.cells[*secondColumn]) : found;
    }
    std::string expected() const {
        return prefix.empty() ? "a level" : "a word " + cleanLine(prefix) + "...";
    }

private:
    std::string_view findLevelWord(std::string_view rest) const {
        while (!rest.empty())
            if (const std::string_view word = takeUntil(' ', rest); word.starts_with(prefix))
                return word.substr(prefix.size());
        return {};
    }
};

std::size_t addLevelAnswers(const StudyRows& rows, StudyData<LevelAnswer>& data,
                            const LevelAnswerColumns& columns) {
    constexpr double maxLevel = 1e6;
    // "choice=left": the answer is 1 where the choice is left
    const std::size_t equalsAt =
        rows.findColumn(columns.measure) ? std::string::npos : columns.measure.find('=');
    const auto measure = rows.requireColumn(columns.measure.substr(0, equalsAt));
    const auto level = LevelSource::findColumns(rows.table(), columns.level);
    if (!level) rows.requireColumn(columns.level);
    const bool isFactor = columns.level == "level_db" && !rows.findColumn(trialColumns::task); // not ours
    // In our own files adaptive levels follow the answers, so they determine no function.
    const auto levelColumn = rows.findColumn("level_db");
    const bool isAdaptive =
        rows.findColumn(trialColumns::task) && columns.measure == "correct" && levelColumn;
    std::set<std::string> matchingSessions; // sessions in which somebody answered "left"
    if (equalsAt != std::string::npos)
        for (const CsvRow& row : rows.table().rows)
            if (row.cells[measure] == columns.measure.substr(equalsAt + 1))
                matchingSessions.insert(rows.sessionOf(row));
    std::size_t count = 0;
    rows.forEachRow(columns.isMagnitude ? AnswerKind::number : AnswerKind::choice, [&](const CsvRow& row) {
        if (row.cells[measure].empty()) return;
        if (columns.isMagnitude && parseNumber<double>(row.cells[measure]) == 0.0) return;
        if (isAdaptive && !row.cells[*levelColumn].empty()) return;
        if (!matchingSessions.empty() && !matchingSessions.contains(rows.sessionOf(row))) return;
        const auto levelValue = parseNumber<double>(level->level(row));
        if (!levelValue || std::abs(*levelValue) > maxLevel)
            throw StudyTableError{rows.table().cellError(
                row, level->column, level->expected() + " that is a number from -1e6 to 1e6")};
        ++count;
        const double answer = columns.isMagnitude ? rows.number(row, measure, minEstimate, maxEstimate)
                              : equalsAt != std::string::npos
                                  ? row.cells[measure] == columns.measure.substr(equalsAt + 1)
                                  : rows.wholeNumber(row, measure, 0, 1);
        trialsOfGroup(
            rows, data,
            conditionKey(rows.conditionOf(row), isFactor ? rows.cellOrEmpty(row, "stimulus") : std::string{}))
            .push_back({rows.cellOrEmpty(row, "participant"), *levelValue, answer});
    });
    return count;
}

/// Columns c1, c2, ... of the table; at least one is required.
std::vector<std::size_t> countColumns(const StudyRows& rows) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 1; i <= maxGridLines; ++i) {
        const auto found = rows.findColumn(std::string("c").append(std::to_string(i)));
        if (!found) break;
        columns.push_back(*found);
    }
    if (columns.empty()) rows.requireColumn("c1");
    if (rows.findColumn(std::string("c").append(std::to_string(maxGridLines + 1))))
        throw StudyTableError{rows.table().name + ": expected at most " + std::to_string(maxGridLines) +
                              " columns c1, c2, ..."};
    return columns;
}

} // namespace

Result<StudyData<IdentificationTrial>> readIdentification(std::span<const NamedText> files) {
    return readAll<StudyData<IdentificationTrial>>(files, [](const StudyRows& rows, auto& data) {
        const auto stimulus = rows.requireColumn("stimulus"), response = rows.requireColumn("response");
        std::size_t missing = 0;
        const std::size_t count = rows.forEachRow(AnswerKind::label, [&](const CsvRow& row) {
            if (row.cells[response].empty() && !rows.text(row, stimulus).empty()) {
                ++missing;
                return;
            }
            trialsOfGroup(rows, data, rows.conditionOf(row))
                .push_back(
                    {rows.text(row, stimulus), row.cells[response], rows.cellOrEmpty(row, "participant")});
        });
        if (missing > 0)
            data.warnings.push_back(rows.table().name + ": " + plural(missing, "trial") +
                                    " without a response left out");
        checkLabelCount(rows.table().name, data);
        return data.groups.empty() ? 0 : count;
    });
}

Result<StudyData<LocationTrial>> readLocations(std::span<const NamedText> files) {
    return readAll<StudyData<LocationTrial>>(files, [](const StudyRows& rows, auto& data) {
        for (const auto& [line, place] : {std::pair{"target_column", "target_x"}, {"target_row", "target_y"}})
            if (!rows.findColumn(line) && rows.findColumn(place))
                throw StudyTableError{
                    rows.table().name + ": column " + place + ": expected at most " +
                    std::to_string(maxGridLines) +
                    " different places, found more; `physvib analyse places` takes targets on no grid"};
        const auto column = rows.requireColumn("target_column"), line = rows.requireColumn("target_row"),
                   x = rows.requireColumn("x"), y = rows.requireColumn("y");
        constexpr int maxLine = static_cast<int>(maxGridLines);
        return rows.forEachRow(AnswerKind::place, [&](const CsvRow& row) {
            trialsOfGroup(rows, data, rows.conditionOf(row))
                .push_back({rows.wholeNumber(row, column, 1, maxLine),
                            rows.wholeNumber(row, line, 1, maxLine), rows.number(row, x, 0.0, 1.0),
                            rows.number(row, y, 0.0, 1.0), rows.cellOrEmpty(row, "participant")});
        });
    });
}

Result<StudyData<PlaceTrial>> readPlaces(std::span<const NamedText> files) {
    return readAll<StudyData<PlaceTrial>>(files, [](const StudyRows& rows, auto& data) {
        if (const auto targets = GridTargets::findColumns(rows)) return addGridPlaces(rows, *targets, data);
        constexpr double maxPlace = 1e9; // limit in any unit
        const auto trueX = rows.requireColumn("target_x"), x = rows.requireColumn("x");
        const auto trueY = rows.findColumn("target_y"), y = rows.findColumn("y");
        const bool hasNames = rows.findColumn("stimulus").has_value();
        if (trueY.has_value() != y.has_value())
            throw StudyTableError{rows.table().name +
                                  ": expected both columns target_y and y, or none of them, found " +
                                  (y ? "y" : "target_y")};
        return rows.forEachRow(AnswerKind::place, [&](const CsvRow& row) {
            const auto number = [&](std::optional<std::size_t> column) {
                return column ? rows.number(row, *column, -maxPlace, maxPlace) : 0.0;
            };
            PlaceTrial trial{rows.cellOrEmpty(row, "participant"),
                             rows.cellOrEmpty(row, "stimulus"),
                             number(trueX),
                             number(trueY),
                             number(x),
                             number(y)};
            if (!hasNames)
                trial.target =
                    numberText(trial.trueX) + (trueY ? "," + numberText(trial.trueY) : std::string{});
            trialsOfGroup(rows, data, rows.conditionOf(row)).push_back(std::move(trial));
        });
    });
}

Result<StudyData<ChoiceTrial>> readChoices(std::span<const NamedText> files) {
    auto data = readAll<StudyData<ChoiceTrial>>(files, [](const StudyRows& rows, auto& all) {
        const auto choice =
            rows.findColumn("choice") ? rows.requireColumn("choice") : rows.requireColumn("response");
        const bool hasTasks = rows.findColumn(trialColumns::task).has_value();
        std::size_t count = 0;
        rows.forEachRow(AnswerKind::choice, [&](const CsvRow& row) {
            // With adaptive levels the method determines the shares, so they are no result.
            if (hasTasks && !rows.cellOrEmpty(row, "correct").empty() &&
                !rows.cellOrEmpty(row, "level_db").empty())
                return;
            ++count;
            trialsOfGroup(rows, all, rows.sessionOf(row))
                .push_back(
                    {rows.cellOrEmpty(row, "participant"),
                     conditionKey(rows.cellOrEmpty(row, "condition"), rows.cellOrEmpty(row, "stimulus")),
                     rows.text(row, choice), rows.cellOrEmpty(row, "parts"),
                     hasTasks ? std::string{} : rows.cellOrEmpty(row, "stimulus")});
        });
        return count;
    });
    for (auto& session : data.value.groups) nameGroups(session.trials, &ChoiceTrial::condition);
    return data;
}

Result<RatingData> readRatings(std::span<const NamedText> files) {
    auto data = readAll<RatingData>(files, addRatings);
    for (auto& session : data.value.groups) nameGroups(session.trials, &RatingTrial::condition);
    return data;
}

Result<StudyData<LevelTrial>> readLevels(std::span<const NamedText> files) {
    return readAll<StudyData<LevelTrial>>(files, addLevelTrials);
}

Result<StudyData<LevelAnswer>> readLevelAnswers(std::span<const NamedText> files,
                                                const LevelAnswerColumns& columns) {
    auto data = readAll<StudyData<LevelAnswer>>(
        files, [&](const StudyRows& rows, auto& all) { return addLevelAnswers(rows, all, columns); });
    nameGroups(data.value.groups, &TrialGroup<LevelAnswer>::name, "");
    return data;
}

Result<StudyData<PercentCounts>> readPercentCounts(std::span<const NamedText> files) {
    return readAll<StudyData<PercentCounts>>(files, [](const StudyRows& rows, auto& data) {
        const auto condition = rows.requireColumn("condition"), row = rows.requireColumn("row");
        const auto columns = countColumns(rows);
        return rows.forEachRow(std::nullopt, [&](const CsvRow& r) {
            auto& grids = trialsOfGroup(rows, data, rows.text(r, condition));
            if (grids.empty()) grids.push_back({r.cells[condition], 0, columns.size(), {}});
            PercentCounts& grid = grids.front();
            const int next = static_cast<int>(++grid.rows);
            const auto expect = [&](bool isValid, std::size_t column, const std::string& words) {
                if (!isValid) throw StudyTableError{rows.table().cellError(r, column, words)};
            };
            expect(grid.columns == columns.size(), condition, "as many columns as in the file before");
            expect(grid.rows <= maxGridLines, row, "at most " + std::to_string(maxGridLines) + " rows");
            expect(rows.wholeNumber(r, row, 1, static_cast<int>(maxGridLines)) == next, row,
                   "row " + std::to_string(next) + " of the condition");
            for (const auto c : columns) grid.percent.push_back(rows.number(r, c, 0.0, 100.0));
        });
    });
}

std::string percentCountsCsv(std::span<const PercentCounts> counts, const Provenance& provenance) {
    std::size_t columns = 0;
    for (const auto& grid : counts) columns = std::max(columns, grid.columns);
    std::string text = provenanceComment(provenance) + "condition,row";
    for (std::size_t c = 1; c <= columns; ++c) text.append(",c").append(std::to_string(c));
    text += '\n';
    for (const auto& grid : counts)
        for (std::size_t row = 0; row < grid.rows; ++row) {
            appendCell(text, grid.condition);
            text.append(",").append(std::to_string(row + 1));
            for (std::size_t c = 0; c < columns; ++c)
                text.append(",").append(c < grid.columns ? numberText(grid.at(row, c)) : "0");
            text += '\n';
        }
    return text;
}

} // namespace physvib
