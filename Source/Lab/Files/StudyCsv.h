// SPDX-License-Identifier: MIT
// Reads trials and percent counts from CSV with checks of every cell, as input of the analyses.
#pragma once
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"
#include "Lab/Study/Psychometric.h"
#include "Lab/Study/Summaries.h"
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Trials that are analysed together: those of one condition, or, of choices and ratings, of one session.
template <class Trial>
struct TrialGroup {
    std::string name; ///< of the condition or session; empty if there is only one without a name
    std::vector<Trial> trials;
};

/// Contents of one or more files of the same kind.
template <class Trial>
struct StudyData {
    std::vector<TrialGroup<Trial>> groups; ///< in the order of first trials
    std::vector<std::string> warnings;     ///< one line each on omitted data
    bool isSimulated = false;              ///< at least one trial comes from a simulated observer
};

struct RatingData : StudyData<RatingTrial> {
    std::vector<std::string> scales; ///< names of a trial's scores
};

/// Summaries of all sessions; nameInSession() adds a session's name to its conditions. Any thread.
template <class Trial, class Summarise>
auto summariseSessions(const StudyData<Trial>& data, Summarise summarise) {
    decltype(summarise(data.groups.front().trials)) summaries;
    for (const auto& session : data.groups)
        for (auto& summary : summarise(session.trials)) {
            summary.condition = nameInSession(std::move(summary.condition), session.name);
            summaries.push_back(std::move(summary));
        }
    return summaries;
}

/// Contents and display name of a file.
struct NamedText {
    std::string_view text, name;
    std::span<const ColumnName> columns{}; ///< mapping of another program's columns; empty: our own names
};

// For all readers: other columns are ignored. Training trials and trials of other tasks in files of `study
// run` are omitted. The first error is `name:17: column x: expected what, found "cell"`. Any thread.

/// Columns stimulus, response; optional condition, participant. Warns of trials without a response.
Result<StudyData<IdentificationTrial>> readIdentification(std::span<const NamedText> files);

/// Columns target_column, target_row (1 to maxGridLines), x, y (0 to 1); optional condition.
Result<StudyData<LocationTrial>> readLocations(std::span<const NamedText> files);

/// Columns target_x, x; optional target_y and y, stimulus (without it the place identifies the target),
/// condition, participant. Coordinates may have any unit. Our own files have target_column, target_row and
/// render instead; their targets become shares of the field, with a warning.
Result<StudyData<PlaceTrial>> readPlaces(std::span<const NamedText> files);

/// Columns choice (or response); optional condition, stimulus, participant. The trials are grouped by
/// session; a single session has no name. The condition of a trial is named by its column condition or
/// stimulus, or by both if both vary: "condition=low stimulus=0.2".
Result<StudyData<ChoiceTrial>> readChoices(std::span<const NamedText> files);

/// Columns stimulus or condition; optional participant. Sessions and conditions are named as by
/// readChoices(). Every column that trial files do not have is a scale from 0 to 100.
Result<RatingData> readRatings(std::span<const NamedText> files);

/// Staircases, QUEST+ sessions, adjustments and magnitude estimations, all in one group. Trials of trainings
/// are omitted, but adjustments are read if the file has no others.
Result<StudyData<LevelTrial>> readLevels(std::span<const NamedText> files);

/// Column names for a fit of answers to levels.
struct LevelAnswerColumns {
    std::string level;        ///< numeric column; if missing, a word `level=...` of condition or stimulus
    std::string measure;      ///< column of answers
    bool isMagnitude = false; ///< answers are magnitudes; otherwise 1 or 0
};

/// The named columns, optional condition and participant. Rows without an answer are omitted.
Result<StudyData<LevelAnswer>> readLevelAnswers(std::span<const NamedText> files,
                                                const LevelAnswerColumns& columns);

/// Columns condition, row, c1 to cN. The rows of each condition are 1, 2, 3...; values are 0 to 100.
Result<StudyData<PercentCounts>> readPercentCounts(std::span<const NamedText> files);

/// `counts` as CSV for readPercentCounts(), one grid row per line. Any thread.
std::string percentCountsCsv(std::span<const PercentCounts> counts, const Provenance& provenance);

} // namespace physvib
