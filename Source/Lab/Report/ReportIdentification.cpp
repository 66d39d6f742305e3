// SPDX-License-Identifier: MIT
// Report sections on identification (information transfer, percent correct) and on pointing.
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"

namespace physvib {
namespace {

using Identified = StudyData<IdentificationTrial>;

struct IdentifiedCondition {
    std::string condition;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
    double percentCorrect; ///< mean of participants
    std::size_t people;    ///< of that mean
};

std::vector<IdentifiedCondition> conditionsOf(const Identified& data, int tolerance) {
    std::vector<IdentifiedCondition> all;
    for (const auto& condition : data.conditions) {
        const auto trials = tolerance == 0 ? condition.trials : withTolerance(condition.trials, tolerance);
        const ConfusionMatrix matrix{trials};
        std::vector<double> shares;
        for (const auto& own : comparable(transferByParticipant(trials), matrix.stimuli()))
            shares.push_back(100.0 * static_cast<double>(own.matrix.correct()) /
                             static_cast<double>(own.matrix.trials()));
        all.push_back({condition.name.empty() ? "all trials" : condition.name, matrix,
                       informationTransfer(matrix), Moments(shares).mean, shares.size()});
    }
    return all;
}

/// Draws grids by place, and other stimuli as a confusion matrix.
std::string stimulusChart(ReportBuilder& report, const IdentifiedCondition& condition,
                          const std::vector<IdentificationTrial>& trials, int tolerance) {
    std::vector<GridCell> cells;
    int rows = 0, columns = 0;
    for (std::size_t i = 0; i < condition.matrix.stimuli(); ++i) {
        const auto cell = parseGridCell(condition.matrix.label(i));
        if (!cell || cell->row > 16 || cell->column > 16) return {};
        cells.push_back(*cell);
        rows = std::max(rows, cell->row);
        columns = std::max(columns, cell->column);
    }
    GridChart chart{report.frame(condition.condition + (tolerance ? ", 1 step of tolerance" : "")), "row",
                    "column"};
    chart.most = 100.0;
    chart.width = 225.0;
    for (int r = 1; r <= rows; ++r) chart.rows.push_back(std::to_string(r));
    for (int c = 1; c <= columns; ++c) chart.columns.push_back(std::to_string(c));
    chart.values.resize(static_cast<std::size_t>(rows * columns));
    std::map<std::string, std::vector<double>> shares; // by stimulus
    for (const auto& own : transferByParticipant(trials))
        for (std::size_t i = 0; i < own.matrix.stimuli(); ++i)
            shares[own.matrix.label(i)].push_back(100.0 * shareCorrect(own.matrix, i));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto at = static_cast<std::size_t>((cells[i].row - 1) * columns + cells[i].column - 1);
        chart.values[at] = Moments(shares[condition.matrix.label(i)]).mean;
    }
    return gridChart(chart);
}

bool isGrid(const Identified& data) {
    return std::ranges::all_of(data.conditions, [](const auto& one) {
        return std::ranges::all_of(
            one.trials, [](const auto& trial) { return parseGridCell(trial.stimulus).has_value(); });
    });
}

/// Tables and charts for one criterion of a correct answer.
void tellCriterion(ReportBuilder& report, const Identified& data, int tolerance) {
    const std::string suffix = tolerance ? "-tolerance-" + std::to_string(tolerance) : "",
                      words = tolerance ? ", 1 step of tolerance" : "";
    AnalysisJob options = report.options();
    options.tolerance = tolerance;
    report.page.subheading(tolerance ? "Answers within one step" : "Exact answers");
    const AnalysisReport confusion = report.analysis("confusion", options, "confusion" + suffix + ".csv");
    if (!confusion.error.empty()) return;
    report.addTable("identification" + suffix + ".csv", confusion.participants);
    const auto all = conditionsOf(data, tolerance);
    BarChart it{report.frame("Information transfer" + words), "condition", "IT (bit)"};
    BarChart pc{report.frame("Percent correct" + words), "condition", "correct (%)"};
    std::vector<std::size_t> people;
    for (const IdentifiedCondition& one : all) {
        it.add(one.condition, ChartValue::around(one.transfer.bits));
        it.ceilings.push_back(one.transfer.mostBits);
        pc.add(one.condition, ChartValue::around(one.percentCorrect));
        people.push_back(one.people);
    }
    it.ceilingWords = "log2 of the number of stimuli";
    pc.most = 100.0;
    report.page.figure({barChart(it)}, "Information transfer of all trials together, not corrected" + words +
                                           ofPeopleIn(data.conditions) +
                                           ". Dotted: log2 of the number of stimuli.");
    report.page.figure({barChart(pc)}, "Mean percent correct" + words + ofPeople(people) + ".");
    std::vector<std::string> charts;
    for (std::size_t c = 0; c < all.size(); ++c) {
        const auto& trials = data.conditions[c].trials;
        charts.push_back(isGrid(data)
                             ? stimulusChart(report, all[c],
                                             tolerance ? withTolerance(trials, tolerance) : trials, tolerance)
                             : confusionChart(report.frame(all[c].condition), all[c].matrix));
    }
    std::erase(charts, std::string{});
    if (charts.empty()) return;
    report.page.figure(charts, isGrid(data) ? "Mean percent correct by place" + words +
                                                  ofPeopleIn(data.conditions) + "."
                                            : "Share of each response, of the trials of a stimulus" +
                                                  ofPeopleIn(data.conditions) + ".");
}

} // namespace

void tellIdentification(ReportBuilder& report) {
    report.page.heading("Identification");
    const auto data = report.read(readIdentification);
    if (!data) return report.tellFault(data.error);
    tellCriterion(report, data.value, 0);
    if (isGrid(data.value)) tellCriterion(report, data.value, 1);
}

// Pointing: responses with normals, perceived rows and columns, likeliest targets, percent counts.

namespace {

using Places = std::vector<StudyCondition<LocationTrial>>;

/// Mean perceived against intended place over participants, for rows (`isRow`) or columns.
std::string perceivedChart(ReportBuilder& report, const Places& places, bool isRow) {
    LineChart chart{report.frame(isRow ? "Perceived row" : "Perceived column"),
                    isRow ? "intended target row" : "intended target column",
                    isRow ? "perceived, share of the height" : "perceived, share of the width"};
    chart.width = 335.0;
    chart.height = 330.0;
    chart.yRange = {0.0, 1.0};
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::map<int, std::map<std::string, std::vector<double>>> answers; // by target and participant
        for (const LocationTrial& trial : places[i].trials)
            answers[isRow ? trial.targetRow : trial.targetColumn][trial.participant].push_back(
                isRow ? trial.y : trial.x);
        LineSeries series{places[i].name};
        series.style = i;
        for (const auto& [line, people] : answers) {
            std::vector<double> means;
            for (const auto& [who, values] : people) means.push_back(Moments(values).mean);
            // so that intervals do not overlap
            const double offset =
                0.08 * (static_cast<double>(i) - 0.5 * static_cast<double>(places.size() - 1));
            series.points.push_back({line + offset, ChartValue::around(Moments(means).mean)});
        }
        chart.series.push_back(std::move(series));
    }
    return lineChart(chart);
}

bool hasEdges(const ReportBuilder& report) {
    return std::ranges::any_of(report.trials.columns,
                               [](const ColumnName& one) { return one.range.has_value(); });
}

} // namespace

void tellPlaces(ReportBuilder& report) {
    auto data = report.read(readLocations);
    const Cells cell{report.trials.all};
    if (!data && cell.has("target_x")) { // of another program: errors need no edges
        const auto lies = [&](const CsvRow& row, const char* axis) {
            const double at = parseNumber<double>(cell(row, axis)).value_or(0.0);
            return at < 0.0 || at > 1.0;
        };
        std::size_t main = 0, outside = 0;
        for (const CsvRow& row : report.trials.all.rows) {
            if (cell(row, trialColumns::phase) == trialColumns::training) continue;
            ++main;
            outside += lies(row, "x") || lies(row, "y");
        }
        if (const auto fault = unitFault(report.trials.columns); !fault.empty()) { // of resolution no matter
            report.page.heading("Perceived places");
            return report.tellFault(fault);
        }
        tellPlaceErrors(report);
        return report.page.note(std::to_string(outside) + " of " + counted(main, "place") +
                                (hasEdges(report) ? " beyond the named edges" : " outside 0 to 1") +
                                ": no territories and grids");
    }
    report.page.heading("Perceived places");
    if (!data) return report.tellFault(data.error);
    AnalysisReport resolution = report.analysis("resolution", report.options(), "resolution.csv");
    if (!resolution.error.empty()) return;
    report.addTable("percent-counts.csv", resolution.counts);
    Places& places = data.value.conditions;
    std::ranges::sort(places, {}, &Places::value_type::name);
    std::vector<std::string> responses, territories, counts, grids;
    for (auto& [name, trials] : places) {
        if (name.empty()) name = "all trials";
        const auto made = resolveCondition(name, trials);
        responses.push_back(responsesChart(report.frame(name), made, trials));
        territories.push_back(territoryChart(report.frame(name), made));
        counts.push_back(countsChart(report.frame(name), made.counts));
        if (!made.resolution.ties.empty()) grids.push_back(mergedChart(report.frame(name), made));
    }
    report.page.figure(responses,
                       "All responses, by colour and shape of the target, and one standard deviation of "
                       "each target's normal distribution" +
                           ofPeopleIn(places) + ".");
    report.page.figure({perceivedChart(report, places, false), perceivedChart(report, places, true)},
                       "Mean perceived column and row by the intended one" + ofPeopleIn(places) + ".");
    report.page.figure(territories,
                       "Likeliest target of each place. Numbers: row,column at the mean of its responses.");
    report.page.figure(counts,
                       "Percent counts: share of the field of which each target is the likeliest. Framed: "
                       "below 1.42 %.");
    if (!grids.empty())
        report.page.figure(grids, "Percent counts of the merged grid of the table, columns x rows.");
}

void tellPlaceErrors(ReportBuilder& report) {
    report.page.heading("Perceived places");
    report.page.paragraph(
        std::string{hasEdges(report) ? "Places are shares of the named edges. "
                                     : "Places are in the table's units. "} +
        "Constant error: mean of answered minus true place. Variable error: standard deviation "
        "around a target's own mean, both axes together. Of each participant's targets the "
        "mean counts. Gain: slope of a participant's answered over true places, of all trials.");
    report.analysis("places", report.options(), "places.csv");
}

} // namespace physvib
