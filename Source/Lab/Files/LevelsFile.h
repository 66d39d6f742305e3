// SPDX-License-Identifier: MIT
// CSV files of stimulus levels that experts adjusted, used by another study.
#pragma once
#include "Core/Limits.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Files/StudyRows.h"
#include "Lab/Study/StimulusLevels.h"
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Parses the columns condition, stimulus, alternative, level_db; otherwise one line that names file, line
/// and column. Any thread.
inline Result<std::vector<StimulusLevel>> readStimulusLevels(std::string_view text, std::string_view name) {
    std::vector<StimulusLevel> levels;
    try {
        const detail::StudyRows rows{text, name};
        const auto condition = rows.required("condition"), stimulus = rows.required("stimulus"),
                   alternative = rows.required("alternative"), level = rows.required("level_db");
        for (const CsvRow& row : rows.table().rows) {
            StimulusLevel next{rows.text(row, condition), rows.text(row, stimulus),
                               rows.text(row, alternative),
                               rows.number(row, level, -limits::maxLevelDb, limits::maxLevelDb)};
            if (levelOf(levels, next.condition, next.stimulus) != nullptr)
                throw detail::StudyFault{
                    rows.table().fault(row, stimulus, "each stimulus of a condition once")};
            levels.push_back(std::move(next));
        }
    } catch (const detail::StudyFault& fault) {
        return Failure{fault.message};
    }
    return levels;
}

/// `levels` as CSV, with number of participants and standard deviation. Any thread.
inline std::string stimulusLevelsCsv(const std::vector<StimulusLevel>& levels, const Provenance& provenance) {
    std::string text = provenanceComment(provenance) +
                       "condition,stimulus,alternative,level_db,participants,standard_deviation\n";
    for (const StimulusLevel& level : levels) {
        for (const std::string* cell : {&level.condition, &level.stimulus, &level.alternative}) {
            appendCell(text, *cell);
            text += ',';
        }
        appendNumber(text, level.levelDb);
        text += ',';
        appendNumber(text, level.participants);
        text += ',';
        appendNumber(text, level.deviationDb);
        text += '\n';
    }
    return text;
}

} // namespace physvib
