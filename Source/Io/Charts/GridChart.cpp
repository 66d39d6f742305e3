// SPDX-License-Identifier: MIT
// Matrix of shaded cells as SVG: confusion matrices, shares by place, percentages.
#include "Io/Charts/ChartParts.h"
#include "Io/Charts/Charts.h"
#include "Io/Text/NumberText.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using namespace detail;

/// White to dark blue; lightness is monotonic, so it also works in greyscale.
std::string shade(double share) {
    const double t = std::clamp(share, 0.0, 1.0);
    const auto mixed = [t](double dark) {
        return std::to_string(static_cast<int>(std::lround(255.0 + t * (dark - 255.0))));
    };
    return "rgb(" + mixed(0) + "," + mixed(60) + "," + mixed(120) + ")";
}

struct GridDrawing {
    const GridChart& chart;
    Svg& svg;
    PlotArea area;

    double cellWidth() const { return area.width() / static_cast<double>(chart.columns.size()); }
    double cellHeight() const { return area.height() / static_cast<double>(chart.rows.size()); }

    void cell(std::size_t row, std::size_t column) const {
        const auto& value = chart.values[row * chart.columns.size() + column];
        if (!value) return;
        const ChartPoint corner{area.left + cellWidth() * static_cast<double>(column),
                                area.top + cellHeight() * static_cast<double>(row)};
        const double share = *value / chart.most;
        if (share > 0.0) svg.rect(corner, cellWidth(), cellHeight(), shade(share));
        if (chart.markedBelow && *value < *chart.markedBelow)
            svg.rect({corner.x + 1.5, corner.y + 1.5}, cellWidth() - 3.0, cellHeight() - 3.0, "none",
                     {"#D55E00", 2.0, "4 3"});
        numbers(corner, row * chart.columns.size() + column, share > 0.5);
    }
    void numbers(ChartPoint corner, std::size_t index, bool isDark) const {
        const std::string words = fixedNumber(*chart.values[index], chart.decimals);
        if (textWidth(words, smallSize) > cellWidth() - 4.0 || cellHeight() < 13.0) return;
        const std::string_view colour = isDark ? "#fff" : "#111";
        const bool hasInterval =
            !chart.halfIntervals.empty() && chart.halfIntervals[index] > 0.0 && cellHeight() >= 28.0;
        const double x = corner.x + 0.5 * cellWidth(),
                     y = corner.y + 0.5 * cellHeight() + (hasInterval ? -2.0 : 4.0);
        svg.text({x, y}, words, {smallSize, Anchor::middle, 0.0, false, colour});
        if (hasInterval)
            svg.text({x, y + 12.0}, "\u00b1" + fixedNumber(chart.halfIntervals[index], chart.decimals),
                     {9.0, Anchor::middle, 0.0, false, colour});
    }
    /// Draws every label that fits.
    void labels() const {
        const auto rowStep = static_cast<std::size_t>(std::ceil(11.0 / cellHeight())),
                   columnStep = static_cast<std::size_t>(std::ceil(13.0 / cellWidth()));
        for (std::size_t r = 0; r < chart.rows.size(); r += rowStep)
            svg.text({area.left - 5.0, area.top + cellHeight() * (static_cast<double>(r) + 0.5) + 3.5},
                     chart.rows[r], {10.0, Anchor::end});
        for (std::size_t c = 0; c < chart.columns.size(); c += columnStep) {
            const double x = area.left + cellWidth() * (static_cast<double>(c) + 0.5);
            if (isTurned())
                svg.text({x + 3.5, area.bottom + 6.0}, chart.columns[c], {10.0, Anchor::end, -90.0});
            else
                svg.text({x, area.bottom + 14.0}, chart.columns[c], {10.0, Anchor::middle});
        }
    }
    bool isTurned() const {
        return std::ranges::any_of(chart.columns, [this](const std::string& words) {
            return textWidth(words, 10.0) > cellWidth() - 2.0;
        });
    }
};

double widest(const std::vector<std::string>& labels) {
    double most = 0.0;
    for (const std::string& label : labels) most = std::max(most, textWidth(label, 10.0));
    return most;
}

} // namespace

std::string gridChart(const GridChart& chart) {
    const double titleBottom = titleHeight(chart.frame.title, chart.width);
    const double left = 26.0 + widest(chart.rows) + 6.0, right = chart.width - 10.0, top = titleBottom + 6.0;
    const double cell = std::min((right - left) / static_cast<double>(chart.columns.size()), 64.0);
    const double height = chart.shape * cell * static_cast<double>(chart.rows.size());
    const PlotArea area{left, top, left + cell * static_cast<double>(chart.columns.size()), top + height};
    const double below = widest(chart.columns) > cell - 2.0 ? widest(chart.columns) + 10.0 : 18.0;
    Svg svg{chart.frame.name, chart.width, area.bottom + below + 20.0};
    drawTitle(svg, chart.frame.title, chart.width);
    const GridDrawing drawing{chart, svg, area};
    for (std::size_t r = 0; r < chart.rows.size(); ++r)
        for (std::size_t c = 0; c < chart.columns.size(); ++c) drawing.cell(r, c);
    svg.rect({area.left, area.top}, area.width(), area.height(), "none", {"#222", 1.0});
    drawing.labels();
    svg.text({14.0, 0.5 * (area.top + area.bottom)}, chart.rowWords, {labelSize, Anchor::middle, -90.0});
    svg.text({0.5 * (area.left + area.right), area.bottom + below + 12.0}, chart.columnWords,
             {labelSize, Anchor::middle});
    return svg.finish(chart.frame.title, chart.frame.isSimulated);
}

} // namespace physvib
