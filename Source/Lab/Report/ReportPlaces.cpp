// SPDX-License-Identifier: MIT
// Report section on pointing: responses with normal distributions, perceived rows and columns, most likely
// targets, and percent counts.
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Report/ReportCells.h"
#include "Lab/Report/ReportSections.h"
#include "Lab/Statistics/Moments.h"
#include "Lab/Study/ResponseMap.h"
#include <set>

namespace physvib {
namespace {

struct PlacesOf {
    std::string condition;
    std::vector<LocationTrial> trials;
    ConditionResolution resolution;
};

/// Mean perceived against intended place over participants, for rows (`isRow`) or columns.
std::string perceivedChart(ReportBuilder& report, const CsvTable& all, const std::vector<PlacesOf>& places,
                           bool isRow) {
    const Cells cell{all};
    LineChart chart{report.frame(isRow ? "Perceived row" : "Perceived column"),
                    isRow ? "intended target row" : "intended target column",
                    isRow ? "perceived, share of the height" : "perceived, share of the width",
                    {}};
    chart.width = 335.0;
    chart.height = 330.0;
    chart.yRange = {0.0, 1.0};
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::map<int, std::map<std::string, std::vector<double>>> answers; // by target and participant
        for (const CsvRow& row : all.rows) {
            if (cell(row, "phase") == "training") continue;
            if (cell.has("condition") && cell(row, "condition") != places[i].condition) continue;
            const auto line = parseNumber<int>(cell(row, isRow ? "target_row" : "target_column"));
            const auto value = parseNumber<double>(cell(row, isRow ? "y" : "x"));
            if (line && value) answers[*line][cell(row, "participant")].push_back(*value);
        }
        LineSeries series{places[i].condition, {}};
        series.style = i;
        for (const auto& [line, people] : answers) {
            std::vector<double> means;
            for (const auto& [who, values] : people) means.push_back(Moments(values).mean);
            const Moments moments{means};
            // so that intervals do not overlap
            const double offset =
                0.08 * (static_cast<double>(i) - 0.5 * static_cast<double>(places.size() - 1));
            series.points.push_back(
                {line + offset, ChartValue::around(moments.mean, moments.halfInterval())});
        }
        chart.series.push_back(std::move(series));
    }
    return lineChart(chart);
}

/// Whether perceived rows or columns differ by target.
void testPlaces(ReportBuilder& report, const PlacesOf& one, bool hasConditions, bool isRow) {
    StudyTest test{StudyTest::Kind::anova, trialsTable, isRow ? "y" : "x"};
    if (hasConditions) test.where = {"condition=" + one.condition};
    std::set<int> rows, columns;
    for (const LocationTrial& trial : one.trials) {
        rows.insert(trial.targetRow);
        columns.insert(trial.targetColumn);
    }
    if (rows.size() > 1) test.within.emplace_back("target_row");
    if (columns.size() > 1) test.within.emplace_back("target_column");
    if (test.within.empty()) return;
    report.test(test);
    if ((isRow ? rows : columns).size() < 2) return;
    test.kind = StudyTest::Kind::pairs;
    test.within = {isRow ? "target_row" : "target_column"};
    test.isBonferroni = true;
    report.test(test);
}

} // namespace

void tellPlaces(ReportBuilder& report) {
    report.page.heading("Perceived places");
    const NamedText file{report.tableText(trialsTable), trialsTable};
    const auto data = readLocations({&file, 1});
    if (!data) return report.page.note(data.error);
    AnalysisReport resolution =
        report.analysis("resolution", report.optionsFor(trialsTable), "resolution.csv");
    if (!resolution.error.empty()) return;
    report.addTable("percent-counts.csv", resolution.counts);
    std::vector<PlacesOf> places;
    for (const auto& condition : data.value.conditions) {
        const std::string name = condition.name.empty() ? "all trials" : condition.name;
        places.push_back({name, condition.trials, resolveCondition(name, condition.trials)});
    }
    std::ranges::sort(places, {}, &PlacesOf::condition);
    std::vector<std::string> responses, territories, counts, grids;
    for (const PlacesOf& one : places) {
        responses.push_back(responsesChart(report.frame(one.condition), one.resolution, one.trials));
        territories.push_back(territoryChart(report.frame(one.condition), one.resolution));
        counts.push_back(countsChart(report.frame(one.condition), one.resolution.counts));
        if (!one.resolution.resolution.ties.empty())
            grids.push_back(mergedChart(report.frame(one.condition), one.resolution));
    }
    report.page.figure(responses,
                       "Every response (dots, coloured by target) and the normal distribution of each "
                       "target's responses (ellipses of one standard deviation; as thesis Fig. 4.6).");
    const auto& all = report.trials.all;
    report.page.figure(
        {perceivedChart(report, all, places, false), perceivedChart(report, all, places, true)},
        "Mean perceived column and row against the intended one (as thesis Fig. 4.7)" + report.intervals() +
            ".");
    report.page.figure(territories, "The likeliest target of every place (Eq. 4.4, 4.5; as thesis Fig. 4.8). "
                                    "Numbers, row,column of the target, stand at the mean of its responses; "
                                    "where one lies in another's territory, it is not told apart.");
    report.page.figure(counts, "Percent counts: the share of the field that each target is likeliest for (as "
                               "thesis Fig. 4.9 a). Framed: below 1.42 %.");
    if (!grids.empty())
        report.page.figure(grids, "Neighbouring rows and columns merged until every cell reaches 1.42 % (as "
                                  "thesis Fig. 4.9 b): the perceptual resolution, columns x rows.");
    report.page.subheading("Do perceived places differ by target?");
    report.page.paragraph("As thesis Table 4.1, but over participants: each participant's mean per target is "
                          "one value. The thesis' degrees of freedom are those of single trials.");
    const bool hasConditions = all.column("condition").has_value() && places.size() > 1;
    for (const PlacesOf& one : places)
        for (const bool isRow : {true, false}) testPlaces(report, one, hasConditions, isRow);
}

void tellPlaceErrors(ReportBuilder& report) {
    report.page.heading("Perceived places");
    report.page.paragraph(
        "Targets on no grid, in the table's own units. Constant error: mean of answered minus true place. "
        "Variable error: standard deviation around a target's own mean, both axes together. Gain: slope of "
        "answered over true places; 1 is neither drawn together nor apart. Means over participants of their "
        "means over targets; each target counts as much.");
    report.analysis("places", report.optionsFor(trialsTable), "places.csv");
}

} // namespace physvib
