// SPDX-License-Identifier: MIT
// Trials of studies and percent counts from CSV, checked cell by cell, for the analyses in Study.
#pragma once
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Files/ColumnNames.h"
#include "Lab/Statistics/LevelFits.h"
#include "Lab/Study/ConfusionMatrix.h"
#include "Lab/Study/LevelTrials.h"
#include "Lab/Study/PercentCounts.h"
#include "Lab/Study/PlaceErrors.h"
#include "Lab/Study/ResponseMap.h"
#include "Lab/Study/Votes.h"
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The trials of one condition, in the order of the file.
template <class Trial>
struct StudyCondition {
    std::string name; ///< empty: the file has no column `condition`
    std::vector<Trial> trials;
};

/// What one or more files of the same kind hold.
template <class Trial>
struct StudyData {
    std::vector<StudyCondition<Trial>> conditions; ///< in the order of their first trial
    std::vector<std::string> warnings;             ///< a line each: what was left out
    bool isSimulated = false;                      ///< at least one trial is a simulated observer's
};

struct RatingData {
    std::vector<std::string> scales; ///< names of a trial's scores
    StudyData<RatingTrial> data;
};

/// A file's bytes and the name to call it by.
struct NamedText {
    std::string_view text, name;
    std::span<const ColumnName> columns{}; ///< of another program's table; empty: the columns have our names
};

// Common to all: columns that are not asked for are ignored; of a file that `study run` wrote, training
// trials and trials of other tasks are left out. The first thing that is wrong is told as `name:17: column x:
// expected what, found "cell"`. Any thread.

/// Columns stimulus, response; condition and participant if there. Trials without a response are left out and
/// told.
Result<StudyData<IdentificationTrial>> readIdentification(std::span<const NamedText> files);

/// Columns target_column, target_row (1 to mostGridLines), x, y (0 to 1); condition if there.
Result<StudyData<LocationTrial>> readLocations(std::span<const NamedText> files);

/// Columns target_x, x; target_y and y, stimulus (else a target is its place), condition and participant if
/// there. Any unit, the same of both. Of our own rows, which have target_column, target_row and render
/// instead of target_x: the true places in shares of the field, as the answers are; a warning says so.
Result<StudyData<PlaceTrial>> readPlaces(std::span<const NamedText> files);

/// Columns choice (or response); condition (or stimulus) and participant if there. One condition holds them
/// all.
Result<StudyData<ChoiceTrial>> readChoices(std::span<const NamedText> files);

/// Columns stimulus (or condition), participant if there; every column that a trial file does not have is a
/// scale, 0 to 100.
Result<RatingData> readRatings(std::span<const NamedText> files);

/// A trial file's staircases, QUEST+ sessions, adjustments (training, too) and magnitude estimations. One
/// condition holds them all.
Result<StudyData<LevelTrial>> readLevels(std::span<const NamedText> files);

/// What a fit is made of, by the names of columns.
struct LevelAnswerColumns {
    std::string level;        ///< of numbers; if there is no such column, a word `level=...` of condition or
                              ///< stimulus
    std::string measure;      ///< of answers
    bool isMagnitude = false; ///< else answers are 1 or 0
};

/// Columns as named, condition and participant if there; rows without an answer are left out.
Result<StudyData<LevelAnswer>> readLevelAnswers(std::span<const NamedText> files,
                                                const LevelAnswerColumns& columns);

/// Columns condition, row, c1 to cN; rows 1, 2, 3... of each condition, numbers from 0 to 100.
Result<StudyData<PercentCounts>> readPercentCounts(std::span<const NamedText> files);

/// readPercentCounts' format, a row per line. Any thread.
std::string percentCountsCsv(std::span<const PercentCounts> counts, const Provenance& provenance);

} // namespace physvib
