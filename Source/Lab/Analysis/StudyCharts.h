// SPDX-License-Identifier: MIT
// Charts of study results: the pictures of `physvib analyse` and figures of reports.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Study/Attenuation.h"
#include "Lab/Study/ConfusionMatrix.h"
#include "Lab/Study/LevelTrials.h"
#include "Lab/Study/ResponseMap.h"
#include "Lab/Study/Votes.h"
#include <span>
#include <string>
#include <vector>

namespace physvib {

// SVG, one chart each. Any thread (allocates).

/// Darker: a larger share of the stimulus' trials.
std::string confusionChart(ChartFrame frame, const ConfusionMatrix& matrix);

/// Every response, and each target's normal as an ellipse of one standard deviation.
std::string responsesChart(ChartFrame frame, const ConditionResolution& one,
                           const std::vector<LocationTrial>& trials);

/// The likeliest target of every place.
std::string territoryChart(ChartFrame frame, const ConditionResolution& one);

/// Percent counts: darker for more, framed below the threshold of merging.
std::string countsChart(ChartFrame frame, const PercentCounts& counts);

/// The counts of the largest grid that merging makes, and its size behind the title. Some grid must have been
/// found.
std::string mergedChart(ChartFrame frame, const ConditionResolution& one);

/// A bar per alternative and summary; the first alternative's bar is marked if two differ from one half, by
/// signed ranks that are corrected by Holm for the chart's bars.
std::string sharesChart(ChartFrame frame, const std::string& groupsWords,
                        const std::vector<std::string>& groups,
                        const std::vector<const ChoiceSummary*>& summaries);

/// Mean scores of conditions, a series per scale.
std::string scoresChart(ChartFrame frame, const std::vector<std::string>& scales,
                        const std::vector<const RatingSummary*>& summaries);
ChartValue scoreOf(const RatingSummary& summary, std::size_t scale);

/// Bars of one series, as shares in percent or levels; `valueWords` with its unit.
std::string barsChart(ChartFrame frame, const std::string& groupsWords, const std::string& valueWords,
                      const std::vector<std::pair<std::string, ChartValue>>& bars,
                      std::optional<double> most = {});

/// The name of a picture's chart of that number.
inline std::string chartName(std::size_t number) { return "chart" + std::to_string(number); }

// Several charts, for a picture:

/// Thresholds, matched levels and magnitudes: a chart per kind, with standard deviations of what is in dB.
std::vector<std::string> levelCharts(std::span<const LevelSummary> summaries, bool isSimulated);

/// Gamma over the frequency: a chart per axis, a curve per layer.
std::vector<std::string> isolationCharts(std::span<const IsolationResult> results);

} // namespace physvib
