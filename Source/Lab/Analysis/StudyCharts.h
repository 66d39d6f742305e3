// SPDX-License-Identifier: MIT
// Charts of study results, for pictures of `physvib analyse` and figures of reports.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Study/Coupling.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"
#include "Lab/Study/Psychometric.h"
#include "Lab/Study/Summaries.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {
// Each returns one chart as SVG. Any thread (allocates).

/// Darker cells have a larger share of the stimulus' trials.
std::string confusionChart(ChartFrame frame, const ConfusionMatrix& matrix);

/// All responses, and each target's normal distribution as an ellipse of one standard deviation.
std::string responsesChart(ChartFrame frame, const ConditionResolution& condition,
                           const std::vector<LocationTrial>& trials);

/// Map of the most likely target at every place.
std::string territoryChart(ChartFrame frame, const ConditionResolution& condition);

/// Grid of percent counts: higher counts are darker; counts below the merging threshold have a frame.
std::string countsChart(ChartFrame frame, const PercentCounts& counts);

/// Counts of the largest merged grid, with its size in the title. Precondition: such a grid was found.
std::string mergedChart(ChartFrame frame, const ConditionResolution& condition);

/// One bar per alternative and summary: the mean of the participants' shares.
std::string sharesChart(ChartFrame frame, const std::vector<ChoiceSummary>& summaries);

/// Mean scores of conditions, one series per scale. `points`: highest score of scores from 1; 0: from 0.
std::string scoresChart(ChartFrame frame, const std::vector<std::string>& scales,
                        const std::vector<RatingSummary>& summaries, int points = 0);

/// Means of one kind by condition and stimulus; an empty string if there are none. `reference`: level and
/// label of a dashed line.
std::string levelChart(ChartFrame frame, std::span<const LevelSummary> summaries, LevelTrial::Kind kind,
                       const std::optional<std::pair<double, std::string>>& reference = {});

/// Name of the chart with that number in a picture.
inline std::string chartName(std::size_t number) { return "chart" + std::to_string(number); }

// Functions that return several charts for a picture:

/// Gamma over frequency: one chart per axis, one curve per layer, or per voltage of a single one.
std::vector<std::string> isolationCharts(std::span<const IsolationResult> results);

// Charts of functions fitted to each participant's trials.

/// Axis labels of the fitted levels and answers.
struct FitLabels {
    std::string level = "level (dB)", answer = "correct";
    /// Name of the level at one half; a choice such as `choice=left` has no correct answer.
    const char* midpointName(const PsychometricModel& model) const {
        return model.guess > 0.0                  ? "threshold"
               : answer.find('=') < answer.size() ? "point of subjective equality"
                                                  : "50 % point";
    }
    /// Name of half the distance from one quarter to three quarters. With a guess rate it is no JND, since
    /// both levels lie on one side of the standard.
    static const char* slopeName(const PsychometricModel& model) {
        return model.guess > 0.0 ? "half interquartile range" : "JND";
    }
};

/// Labels of another program's table, by its column mapping or the chosen columns, if any. Any thread.
FitLabels fitLabels(std::span<const ColumnName> columns, const std::string& level = {},
                    const std::string& measure = {});

// SVG. Participants without a fit are omitted. Any thread (allocates).

/// `methodThreshold`: the threshold of the method that chose the levels, shown in place of those of the fits.
/// Trials of participants without a fit are shown only if no participant has one.
std::string psychometricChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                              const PsychometricModel& model, const FitLabels& labels,
                              const LevelSummary* methodThreshold = nullptr);
std::string powerLawChart(ChartFrame frame, const std::vector<LevelAnswer>& trials,
                          const std::string& levelLabel);

} // namespace physvib
