// SPDX-License-Identifier: MIT
// Percent counts as a picture: of a study's responses, of what merging makes of them, and of those that are
// published.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Study/PercentCounts.h"
#include <string>
#include <utility>

namespace physvib {

/// Darker for more, framed below the threshold of merging; SVG. Any thread.
inline std::string countsChart(ChartFrame frame, const PercentCounts& counts) {
    GridChart chart{std::move(frame), "row", "column", {}, {}, {}};
    for (std::size_t r = 0; r < counts.rows; ++r) chart.rows.push_back(std::to_string(r + 1));
    for (std::size_t c = 0; c < counts.columns; ++c) chart.columns.push_back(std::to_string(c + 1));
    for (const double percent : counts.percent) chart.values.push_back(percent);
    chart.most = 10.0;
    chart.shape = 0.6;
    chart.decimals = 2;
    chart.markedBelow = defaultPercentThreshold;
    return gridChart(chart);
}

} // namespace physvib
