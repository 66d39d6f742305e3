// SPDX-License-Identifier: MIT
// Readers for each kind of study table.
#include "Lab/Files/StudyCsv.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/NameList.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/QuestMethod.h"
#include "Lab/Study/Stimulus.h"
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace physvib {
namespace {

using detail::StudyFault;
using detail::StudyRows;

template <class Trial>
std::vector<Trial>& conditionNamed(const StudyRows& rows, StudyData<Trial>& data, const std::string& name) {
    const auto found = std::ranges::find(data.conditions, name, &StudyCondition<Trial>::name);
    if (found != data.conditions.end()) return found->trials;
    if (data.conditions.size() == limits::maxConditions)
        throw StudyFault{rows.table().name + ": expected at most " + std::to_string(limits::maxConditions) +
                         " conditions, found more"};
    data.conditions.push_back({name, {}});
    return data.conditions.back().trials;
}

/// Runs `take(rows, data)` per file. Exceptions become a Failure, and so do files without a usable trial.
template <class Data, class Take>
Result<Data> readAll(std::span<const NamedText> files, Take take) {
    Data data;
    SharedParticipants shared;
    try {
        std::vector<StudyRows> tables;
        StudyRows::Sessions sessions;
        for (const NamedText& file : files)
            tables.emplace_back(file.text, file.name, file.columns).addSessions(sessions);
        for (StudyRows& rows : tables) {
            rows.partBy(sessions);
            if (auto fault = shared.add(rows.table()); !fault.empty()) throw StudyFault{std::move(fault)};
            data.isSimulated |= saysSimulated(rows.table());
            const std::size_t taken = take(rows, data);
            rows.warn(data.warnings);
            if (taken == 0)
                throw StudyFault{rows.table().name + ": expected trials of this kind, found none"};
        }
    } catch (const StudyFault& fault) {
        return Failure{fault.message};
    }
    if (std::string note = shared.note(); !note.empty()) data.warnings.push_back(std::move(note));
    return data;
}

/// Limits the number of labels, because a confusion matrix has a row and a column for each.
void expectFewLabels(const std::string& file, const StudyData<IdentificationTrial>& data) {
    std::set<std::string_view> labels;
    for (const auto& condition : data.conditions)
        for (const auto& trial : condition.trials) {
            labels.insert(trial.stimulus);
            labels.insert(trial.response);
            if (labels.size() > limits::maxLabels)
                throw StudyFault{file + ": expected at most " + std::to_string(limits::maxLabels) +
                                 " different stimuli and responses, found more"};
        }
}

/// Target columns of our own trial files: a grid cell, and the render call that contains the grid.
struct OwnTargets {
    std::size_t row, column, call;

    static std::optional<OwnTargets> of(const StudyRows& rows) {
        const auto row = rows.optional("target_row"), column = rows.optional("target_column"),
                   call = rows.optional(trialColumns::render);
        if (rows.optional("target_x") || !row || !column || !call) return std::nullopt;
        return OwnTargets{*row, *column, *call};
    }

    FieldPlace placeIn(const StudyRows& rows, const CsvRow& r) const {
        constexpr int most = static_cast<int>(mostGridLines);
        const GridCell cell{rows.wholeNumber(r, row, 1, most), rows.wholeNumber(r, column, 1, most)};
        const auto grid = gridOf(r.cells[call]);
        if (!grid || cell.row > grid->rows || cell.column > grid->columns)
            throw StudyFault{rows.table().fault(r, call, "a call with the --grid that the target is of")};
        return grid->place(cell);
    }
};

std::size_t takeOwnPlaces(const StudyRows& rows, const OwnTargets& targets, StudyData<PlaceTrial>& data) {
    const auto x = rows.required("x"), y = rows.required("y");
    const std::string unit = "true places are those of the calls' grids, in shares of the field's width and "
                             "height, y downwards; a distance counts both shares alike";
    if (std::ranges::find(data.warnings, unit) == data.warnings.end()) data.warnings.push_back(unit);
    return rows.each(AnswerKind::place, [&](const CsvRow& row) {
        const FieldPlace truth = targets.placeIn(rows, row);
        conditionNamed(rows, data, rows.conditionOf(row))
            .push_back({rows.named(row, "participant"), rows.named(row, "stimulus"), truth.x, truth.y,
                        rows.number(row, x, 0.0, 1.0), rows.number(row, y, 0.0, 1.0)});
    });
}

constexpr char betweenKinds = '\n'; // in no cell

/// Temporary name of a condition and stimulus, until nameKinds().
std::string kindOf(const std::string& condition, const std::string& stimulus) {
    return condition + betweenKinds + stimulus;
}

/// Trials are told apart by condition or stimulus, or by words of both where both differ:
/// "condition=low stimulus=0.2".
template <class Trial>
void nameKinds(std::vector<Trial>& trials, std::string Trial::*kind, const std::string& none = "all trials") {
    std::set<std::string, std::less<>> conditions, stimuli;
    const auto parts = [](std::string_view rest) {
        const std::string_view condition = takeUntil(betweenKinds, rest);
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
        const bool isOne = stimulus.empty() || (conditions.size() > 1 && stimuli.size() == 1);
        trial.*kind = condition.empty() && stimulus.empty() ? none
                      : isOne                               ? std::string{condition}
                      : conditions.size() < 2
                          ? std::string{stimulus}
                          : words("condition", condition) + " " + words("stimulus", stimulus);
    }
}

/// Whether another program's column tells of people, as age does: one value of each, not of all, more rows.
bool isOfPeople(const CsvTable& table, std::size_t column) {
    const auto who = table.column("participant");
    if (!who || table.column(trialColumns::task)) return false;
    std::map<std::string, std::set<std::string>> values;
    for (const CsvRow& row : table.rows) values[row.cells[*who]].insert(row.cells[column]);
    const auto isAlike = [&](const auto& own) { return own.second == values.begin()->second; };
    return values.size() < table.rows.size() &&
           (values.size() == 1 || !std::ranges::all_of(values, isAlike)) &&
           std::ranges::all_of(values, [](const auto& own) { return own.second.size() == 1; });
}

std::vector<std::size_t> scaleColumns(const CsvTable& table, std::vector<std::string>& warnings) {
    std::vector<std::size_t> scales, ofPeople;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
        if (!trialColumns::has(table.columns[c])) (isOfPeople(table, c) ? ofPeople : scales).push_back(c);
    if (scales.empty()) return ofPeople;
    for (const std::size_t c : ofPeople)
        warnings.push_back(table.name + ": column " + cleanLine(table.columns[c]) +
                           " has one value of each participant: a fact of people, no scale");
    return scales;
}

std::size_t takeRatings(const StudyRows& rows, RatingData& ratings) {
    const auto scales = scaleColumns(rows.table(), ratings.warnings);
    std::vector<std::string> names;
    for (const auto c : scales) names.push_back(rows.table().columns[c]);
    if (names.empty())
        throw StudyFault{rows.table().name + ": expected a column per rating scale, found none"};
    if (!ratings.scales.empty() && ratings.scales != names)
        throw StudyFault{rows.table().name + ": expected the scales of the files before"};
    ratings.scales = names;
    const auto& all = rows.table().rows;
    const auto groupOf = [&](const CsvRow& row) { return rows.named(row, trialColumns::group); };
    const bool hasGroups = std::ranges::any_of(all, [&](const auto&row) { return !groupOf(row).empty(); }),
               isOne = std::ranges::all_of(all, [&](const CsvRow&row) {
                   return rows.named(row, "stimulus") == rows.named(all.front(), "stimulus");
               });
    return rows.each(AnswerKind::scores, [&](const CsvRow& row) {
        RatingTrial trial{rows.named(row, "participant"),
                          kindOf(rows.named(row, "condition"),
                                 hasGroups && isOne ? std::string{} : rows.named(row, "stimulus")),
                          {}};
        if (hasGroups)
            trial.condition.append(trial.condition.ends_with(betweenKinds) ? "group=" : " group=")
                .append(groupOf(row).empty() ? "not known" : groupOf(row));
        for (const auto c : scales) // of this session; others lack answers
            trial.scores.push_back(row.cells[c].empty() ? std::nan("") : rows.number(row, c, 0.0, 100.0));
        conditionNamed(rows, ratings, rows.sessionOf(row)).push_back(std::move(trial));
    });
}

/// A level trial, or nullopt if the row is of another kind.
std::optional<LevelTrial> levelTrial(const StudyRows& rows, const CsvRow& row) {
    const bool hasTasks = rows.optional(trialColumns::task).has_value();
    // tables of other programs have no task column and one kind of trial
    const std::optional<AnswerKind> answer = hasTasks ? answerOf(rows.named(row, trialColumns::task))
                                             : rows.optional("value") ? AnswerKind::number
                                                                      : AnswerKind::choice;
    if (answer != AnswerKind::level && answer != AnswerKind::number &&
        (answer != AnswerKind::choice || rows.cell(row, "correct").empty() ||
         (hasTasks && rows.cell(row, "level_db").empty())))
        return std::nullopt;
    LevelTrial trial{answer == AnswerKind::level    ? LevelTrial::Kind::adjustment
                     : answer == AnswerKind::number ? LevelTrial::Kind::magnitude
                                                    : LevelTrial::Kind::staircase,
                     rows.named(row, "participant"), rows.conditionOf(row),
                     rows.named(row, rows.optional("stimulus") ? "stimulus" : "level_db")};
    if (trial.kind != LevelTrial::Kind::staircase) {
        trial.value = rows.number(row, "value",
                                  trial.kind == LevelTrial::Kind::magnitude ? leastEstimate : -mostEstimate,
                                  mostEstimate);
        return trial;
    }
    trial.levelDb = rows.number(row, "level_db", -1000.0, 1000.0);
    trial.session = rows.named(row, "session");
    if (const auto mixed = rows.named(row, trialColumns::staircase); !mixed.empty())
        trial.session += "/" + mixed; // a run of its own
    trial.value = rows.cell(row, "correct") == "1" ? 1.0 : 0.0;
    trial.quest = rows.named(row, trialColumns::quest);
    if (trial.quest.empty()) return trial;
    if (!questPlan(trial.quest))
        throw StudyFault{
            rows.table().fault(row, rows.required(trialColumns::quest), "the words of a QUEST+ session")};
    trial.kind = LevelTrial::Kind::quest;
    trial.value = rows.wholeNumber(row, "correct", 0, 1);
    return trial;
}

std::size_t takeLevelTrial(const StudyRows& rows, StudyData<LevelTrial>& data) {
    std::size_t taken = 0, ofTraining = 0, zeros = 0;
    std::set<std::string> whose;
    const bool hasTasks = rows.optional(trialColumns::task).has_value(),
               hasValues = rows.optional("value").has_value();
    if (!hasTasks && !hasValues) rows.required("correct");
    const auto isTraining = [&](const CsvRow& row) {
        return rows.named(row, trialColumns::phase) == trialColumns::training;
    };
    const auto answerIn = [&](const CsvRow& row) { return answerOf(rows.named(row, trialColumns::task)); };
    // Levels that are only matched before the study are no training of matching.
    const bool hasMatches = std::ranges::any_of(rows.table().rows, [&](const CsvRow& row) {
        return answerIn(row) == AnswerKind::level && !isTraining(row);
    });
    for (const CsvRow& row : rows.table().rows) {
        const auto answer = answerIn(row);
        if (isTraining(row) && (answer != AnswerKind::level || hasMatches)) continue;
        if (answer == AnswerKind::wish) continue; // explorations have no stimulus
        if (hasTasks ? answer == AnswerKind::number : hasValues) {
            const std::string& value = rows.cell(row, "value");
            const bool isZero = parseNumber<double>(value) == 0.0;
            if (zeros += isZero; isZero) {
                const std::string who = cleanLine(rows.named(row, "participant"));
                whose.insert(who.empty() ? who : inSession(who, cleanLine(rows.conditionOf(row))));
            }
            if (isZero || value.empty()) continue;
        }
        if (auto trial = levelTrial(rows, row)) {
            ++taken;
            ofTraining += isTraining(row);
            conditionNamed(rows, data, {}).push_back(std::move(*trial));
        }
    }
    if (ofTraining > 0) data.warnings.emplace_back("levels were set in a training, and no others: it counts");
    if (taken > 0 && !rows.optional("stimulus") && rows.optional("level_db") && hasValues)
        data.warnings.push_back(rows.table().name + " has no column stimulus: level_db (dB) stands for it");
    if (zeros > 0)
        data.warnings.push_back(counted(zeros, "magnitude") + " of 0, which has no logarithm, left out" +
                                (whose.contains("") ? "" : ": of " + joined(whose, ", ")));
    return taken;
}

/// Where a table's levels are: a column of that name, or `name=level` in the words of condition or stimulus.
struct LevelSource {
    std::size_t column = 0;
    std::string mark{}; ///< "level_g="; empty: the whole cell
    std::optional<std::size_t> alsoIn{};

    static std::optional<LevelSource> of(const CsvTable& table, const std::string& name) {
        if (const auto column = table.column(name)) return LevelSource{*column};
        const auto condition = table.column("condition"), stimulus = table.column("stimulus");
        if (!condition && !stimulus) return std::nullopt;
        return LevelSource{condition.value_or(stimulus.value_or(0)), name + "=", stimulus};
    }
    std::string_view level(const CsvRow& row) const {
        if (mark.empty()) return row.cells[column];
        const std::string_view found = markedIn(row.cells[column]);
        return found.empty() && alsoIn ? markedIn(row.cells[*alsoIn]) : found;
    }
    std::string expected() const { return mark.empty() ? "a level" : "a word " + cleanLine(mark) + "..."; }

private:
    std::string_view markedIn(std::string_view rest) const {
        while (!rest.empty())
            if (const std::string_view word = takeUntil(' ', rest); word.starts_with(mark))
                return word.substr(mark.size());
        return {};
    }
};

std::size_t takeLevelAnswers(const StudyRows& rows, StudyData<LevelAnswer>& data,
                             const LevelAnswerColumns& columns) {
    constexpr double largestLevel = 1e6;
    // "choice=left": 1 where it is so
    const std::size_t words = rows.optional(columns.measure) ? std::string::npos : columns.measure.find('=');
    const auto measure = rows.required(columns.measure.substr(0, words));
    const auto level = LevelSource::of(rows.table(), columns.level);
    if (!level) rows.required(columns.level);
    const bool isFactor = columns.level == "level_db" && !rows.optional(trialColumns::task); // of others
    // Levels of our own files' right and wrong choices were chosen by the answers, which tell no function.
    const auto moved = rows.optional("level_db");
    const bool isOwn = rows.optional(trialColumns::task) && columns.measure == "correct" && moved;
    std::set<std::string> asked; // sessions with the answer "left"
    if (words != std::string::npos)
        for (const CsvRow& row : rows.table().rows)
            if (row.cells[measure] == columns.measure.substr(words + 1)) asked.insert(rows.sessionOf(row));
    std::size_t taken = 0;
    rows.each(columns.isMagnitude ? AnswerKind::number : AnswerKind::choice, [&](const CsvRow& row) {
        if (row.cells[measure].empty()) return;
        if (columns.isMagnitude && parseNumber<double>(row.cells[measure]) == 0.0) return;
        if (isOwn && !row.cells[*moved].empty()) return;
        if (!asked.empty() && !asked.contains(rows.sessionOf(row))) return;
        const auto at = parseNumber<double>(level->level(row));
        if (!at || std::abs(*at) > largestLevel)
            throw StudyFault{rows.table().fault(row, level->column,
                                                level->expected() + " that is a number from -1e6 to 1e6")};
        ++taken;
        const double answer = columns.isMagnitude ? rows.number(row, measure, leastEstimate, mostEstimate)
                              : words != std::string::npos
                                  ? row.cells[measure] == columns.measure.substr(words + 1)
                                  : rows.wholeNumber(row, measure, 0, 1);
        conditionNamed(rows, data,
                       kindOf(rows.conditionOf(row), isFactor ? rows.named(row, "stimulus") : std::string{}))
            .push_back({rows.named(row, "participant"), *at, answer});
    });
    return taken;
}

/// Columns c1, c2, ... of the table; at least one is required.
std::vector<std::size_t> countColumns(const StudyRows& rows) {
    std::vector<std::size_t> columns;
    for (std::size_t i = 1; i <= mostGridLines; ++i) {
        const auto found = rows.optional(std::string("c").append(std::to_string(i)));
        if (!found) break;
        columns.push_back(*found);
    }
    if (columns.empty()) rows.required("c1");
    if (rows.optional(std::string("c").append(std::to_string(mostGridLines + 1))))
        throw StudyFault{rows.table().name + ": expected at most " + std::to_string(mostGridLines) +
                         " columns c1, c2, ..."};
    return columns;
}

} // namespace

Result<StudyData<IdentificationTrial>> readIdentification(std::span<const NamedText> files) {
    return readAll<StudyData<IdentificationTrial>>(files, [](const StudyRows& rows, auto& data) {
        const auto stimulus = rows.required("stimulus"), response = rows.required("response");
        std::size_t missing = 0;
        const std::size_t taken = rows.each(AnswerKind::label, [&](const CsvRow& row) {
            if (row.cells[response].empty() && !rows.text(row, stimulus).empty()) {
                ++missing;
                return;
            }
            conditionNamed(rows, data, rows.conditionOf(row))
                .push_back({rows.text(row, stimulus), row.cells[response], rows.named(row, "participant")});
        });
        if (missing > 0)
            data.warnings.push_back(rows.table().name + ": " + counted(missing, "trial") +
                                    " without a response left out");
        expectFewLabels(rows.table().name, data);
        return data.conditions.empty() ? 0 : taken;
    });
}

Result<StudyData<LocationTrial>> readLocations(std::span<const NamedText> files) {
    return readAll<StudyData<LocationTrial>>(files, [](const StudyRows& rows, auto& data) {
        for (const auto& [line, place] : {std::pair{"target_column", "target_x"}, {"target_row", "target_y"}})
            if (!rows.optional(line) && rows.optional(place))
                throw StudyFault{
                    rows.table().name + ": column " + place + ": expected at most " +
                    std::to_string(mostGridLines) +
                    " different places, found more; `physvib analyse places` takes targets on no grid"};
        const auto column = rows.required("target_column"), line = rows.required("target_row"),
                   x = rows.required("x"), y = rows.required("y");
        constexpr int most = static_cast<int>(mostGridLines);
        return rows.each(AnswerKind::place, [&](const CsvRow& row) {
            conditionNamed(rows, data, rows.conditionOf(row))
                .push_back({rows.wholeNumber(row, column, 1, most), rows.wholeNumber(row, line, 1, most),
                            rows.number(row, x, 0.0, 1.0), rows.number(row, y, 0.0, 1.0),
                            rows.named(row, "participant")});
        });
    });
}

Result<StudyData<PlaceTrial>> readPlaces(std::span<const NamedText> files) {
    return readAll<StudyData<PlaceTrial>>(files, [](const StudyRows& rows, auto& data) {
        if (const auto own = OwnTargets::of(rows)) return takeOwnPlaces(rows, *own, data);
        constexpr double farthest = 1e9; // limit in any unit
        const auto trueX = rows.required("target_x"), x = rows.required("x");
        const auto trueY = rows.optional("target_y"), y = rows.optional("y");
        const bool hasNames = rows.optional("stimulus").has_value();
        if (trueY.has_value() != y.has_value())
            throw StudyFault{rows.table().name +
                             ": expected both columns target_y and y, or none of them, found " +
                             (y ? "y" : "target_y")};
        return rows.each(AnswerKind::place, [&](const CsvRow& row) {
            const auto number = [&](std::optional<std::size_t> column) {
                return column ? rows.number(row, *column, -farthest, farthest) : 0.0;
            };
            PlaceTrial trial{rows.named(row, "participant"),
                             rows.named(row, "stimulus"),
                             number(trueX),
                             number(trueY),
                             number(x),
                             number(y)};
            if (!hasNames)
                trial.target =
                    numberText(trial.trueX) + (trueY ? "," + numberText(trial.trueY) : std::string{});
            conditionNamed(rows, data, rows.conditionOf(row)).push_back(std::move(trial));
        });
    });
}

Result<StudyData<ChoiceTrial>> readChoices(std::span<const NamedText> files) {
    auto data = readAll<StudyData<ChoiceTrial>>(files, [](const StudyRows& rows, auto& all) {
        const auto choice = rows.optional("choice") ? rows.required("choice") : rows.required("response");
        const bool isOwn = rows.optional(trialColumns::task).has_value();
        std::size_t taken = 0;
        rows.each(AnswerKind::choice, [&](const CsvRow& row) {
            // With adaptive levels the method determines the shares, so they are no result.
            if (isOwn && !rows.named(row, "correct").empty() && !rows.named(row, "level_db").empty()) return;
            ++taken;
            conditionNamed(rows, all, rows.sessionOf(row))
                .push_back({rows.named(row, "participant"),
                            kindOf(rows.named(row, "condition"), rows.named(row, "stimulus")),
                            rows.text(row, choice), rows.named(row, "parts"),
                            isOwn ? std::string{} : rows.named(row, "stimulus")});
        });
        return taken;
    });
    for (auto& all : data.value.conditions) nameKinds(all.trials, &ChoiceTrial::condition);
    return data;
}

Result<RatingData> readRatings(std::span<const NamedText> files) {
    auto data = readAll<RatingData>(files, takeRatings);
    for (auto& all : data.value.conditions) nameKinds(all.trials, &RatingTrial::condition);
    return data;
}

Result<StudyData<LevelTrial>> readLevels(std::span<const NamedText> files) {
    return readAll<StudyData<LevelTrial>>(files, takeLevelTrial);
}

Result<StudyData<LevelAnswer>> readLevelAnswers(std::span<const NamedText> files,
                                                const LevelAnswerColumns& columns) {
    auto data = readAll<StudyData<LevelAnswer>>(
        files, [&](const StudyRows& rows, auto& all) { return takeLevelAnswers(rows, all, columns); });
    nameKinds(data.value.conditions, &StudyCondition<LevelAnswer>::name, "");
    return data;
}

Result<StudyData<PercentCounts>> readPercentCounts(std::span<const NamedText> files) {
    return readAll<StudyData<PercentCounts>>(files, [](const StudyRows& rows, auto& data) {
        const auto condition = rows.required("condition"), row = rows.required("row");
        const auto columns = countColumns(rows);
        return rows.each(std::nullopt, [&](const CsvRow& r) {
            auto& grids = conditionNamed(rows, data, rows.text(r, condition));
            if (grids.empty()) grids.push_back({r.cells[condition], 0, columns.size(), {}});
            PercentCounts& grid = grids.front();
            const int next = static_cast<int>(++grid.rows);
            const auto expect = [&](bool isSo, std::size_t column, const std::string& words) {
                if (!isSo) throw StudyFault{rows.table().fault(r, column, words)};
            };
            expect(grid.columns == columns.size(), condition, "as many columns as in the file before");
            expect(grid.rows <= mostGridLines, row, "at most " + std::to_string(mostGridLines) + " rows");
            expect(rows.wholeNumber(r, row, 1, static_cast<int>(mostGridLines)) == next, row,
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
