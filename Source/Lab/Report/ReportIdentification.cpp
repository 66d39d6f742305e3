// SPDX-License-Identifier: MIT
// Report sections on identification (information transfer, percent correct) and on pointing.
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"

namespace physvib {
namespace {

using IdentificationData = StudyData<IdentificationTrial>;

struct IdentifiedCondition {
    std::string condition;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
    double percentCorrect; ///< mean of participants
    std::size_t people;    ///< of that mean
};

std::vector<IdentifiedCondition> makeConditions(const IdentificationData& data, int tolerance) {
    std::vector<IdentifiedCondition> all;
    for (const auto& condition : data.groups) {
        const auto trials = tolerance == 0 ? condition.trials : tolerate(condition.trials, tolerance);
        const ConfusionMatrix matrix{trials};
        std::vector<double> shares;
        for (const auto& person : keepComplete(transferByParticipant(trials), matrix.stimuli()))
            shares.push_back(100.0 * static_cast<double>(person.matrix.correct()) /
                             static_cast<double>(person.matrix.trials()));
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
    GridChart chart{report.nextFrame(condition.condition + (tolerance ? ", 1 step of tolerance" : "")), "row",
                    "column"};
    chart.max = 100.0;
    chart.width = 225.0;
    for (int r = 1; r <= rows; ++r) chart.rows.push_back(std::to_string(r));
    for (int c = 1; c <= columns; ++c) chart.columns.push_back(std::to_string(c));
    chart.values.resize(static_cast<std::size_t>(rows * columns));
    std::map<std::string, std::vector<double>> shares; // by stimulus
    for (const auto& person : transferByParticipant(trials))
        for (std::size_t i = 0; i < person.matrix.stimuli(); ++i)
            shares[person.matrix.label(i)].push_back(100.0 * shareCorrect(person.matrix, i));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto at = static_cast<std::size_t>((cells[i].row - 1) * columns + cells[i].column - 1);
        chart.values[at] = Moments(shares[condition.matrix.label(i)]).mean;
    }
    return gridChart(chart);
}

bool isGrid(const IdentificationData& data) {
    return std::ranges::all_of(data.groups, [](const auto& one) {
        return std::ranges::all_of(
            one.trials, [](const auto& trial) { return parseGridCell(trial.stimulus).has_value(); });
    });
}

/// Tables and charts for one criterion of a correct answer.
void addCriterion(ReportBuilder& report, const IdentificationData& data, int tolerance) {
    const std::string suffix = tolerance ? "-tolerance-" + std::to_string(tolerance) : "",
                      words = tolerance ? ", 1 step of tolerance" : "";
    AnalysisJob options = report.options();
    options.tolerance = tolerance;
    report.page.addSubheading(tolerance ? "Answers within one step" : "Exact answers");
    const AnalysisReport confusion = report.addAnalysis("confusion", options, "confusion" + suffix + ".csv");
    if (!confusion.error.empty()) return;
    report.addTable("identification" + suffix + ".csv", confusion.participants);
    const auto all = makeConditions(data, tolerance);
    BarChart transferChart{report.nextFrame("Information transfer" + words), "condition", "IT (bit)"};
    BarChart percentChart{report.nextFrame("Percent correct" + words), "condition", "correct (%)"};
    std::vector<std::size_t> people;
    for (const IdentifiedCondition& condition : all) {
        transferChart.add(condition.condition, ChartValue::withMargin(condition.transfer.bits));
        transferChart.ceilings.push_back(condition.transfer.maxBits);
        percentChart.add(condition.condition, ChartValue::withMargin(condition.percentCorrect));
        people.push_back(condition.people);
    }
    transferChart.ceilingLabel = "log2 of the number of stimuli";
    percentChart.max = 100.0;
    report.page.addFigure({barChart(transferChart)},
                          "Information transfer of all trials together, not corrected" + words +
                              participantCountsText(data.groups) +
                              ". Dotted: log2 of the number of stimuli.");
    report.page.addFigure({barChart(percentChart)},
                          "Mean percent correct" + words + participantCountText(people) + ".");
    std::vector<std::string> charts;
    for (std::size_t c = 0; c < all.size(); ++c) {
        const auto& trials = data.groups[c].trials;
        charts.push_back(
            isGrid(data)
                ? stimulusChart(report, all[c], tolerance ? tolerate(trials, tolerance) : trials, tolerance)
                : confusionChart(report.nextFrame(all[c].condition), all[c].matrix));
    }
    std::erase(charts, std::string{});
    if (charts.empty()) return;
    report.page.addFigure(charts, isGrid(data) ? "Mean percent correct by place" + words +
                                                     participantCountsText(data.groups) + "."
                                               : "Share of each response, of the trials of a stimulus" +
                                                     participantCountsText(data.groups) + ".");
}

} // namespace

void addIdentificationSection(ReportBuilder& report) {
    report.page.addHeading("Identification");
    const auto data = report.read(readIdentification);
    if (!data) return report.noteFailedAnalysis(data.error);
    addCriterion(report, data.value, 0);
    if (isGrid(data.value)) addCriterion(report, data.value, 1);
}

// Pointing: responses with normals, perceived rows and columns, likeliest targets, percent counts.

namespace {

using Places = std::vector<TrialGroup<LocationTrial>>;

/// Mean perceived against intended place over participants, for rows (`isRow`) or columns.
std::string perceivedChart(ReportBuilder& report, const Places& places, bool isRow) {
    LineChart chart{report.nextFrame(isRow ? "Perceived row" : "Perceived column"),
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
            for (const auto& [participant, values] : people) means.push_back(Moments(values).mean);
            // so that intervals do not overlap
            const double offset =
                0.08 * (static_cast<double>(i) - 0.5 * static_cast<double>(places.size() - 1));
            series.points.push_back({line + offset, ChartValue::withMargin(Moments(means).mean)});
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

void addPlacesSection(ReportBuilder& report) {
    auto data = report.read(readLocations);
    const Cells cell{report.trials.all};
    if (!data && cell.has("target_x")) { // another program's table: errors need no edges
        const auto isOutside = [&](const CsvRow& row, const char* axis) {
            const double at = parseNumber<double>(cell(row, axis)).value_or(0.0);
            return at < 0.0 || at > 1.0;
        };
        std::size_t mainTrials = 0, outsideTrials = 0;
        for (const CsvRow& row : report.trials.all.rows) {
            if (cell(row, trialColumns::phase) == trialColumns::training) continue;
            ++mainTrials;
            outsideTrials += isOutside(row, "x") || isOutside(row, "y");
        }
        if (const auto error = unitError(report.trials.columns); !error.empty()) { // errors need one unit
            report.page.addHeading("Perceived places");
            return report.noteFailedAnalysis(error);
        }
        addPlaceErrorsSection(report);
        return report.page.addNote(std::to_string(outsideTrials) + " of " + plural(mainTrials, "place") +
                                   (hasEdges(report) ? " beyond the named edges" : " outside 0 to 1") +
                                   ": no territories and grids");
    }
    report.page.addHeading("Perceived places");
    if (!data) return report.noteFailedAnalysis(data.error);
    AnalysisReport resolution = report.addAnalysis("resolution", report.options(), "resolution.csv");
    if (!resolution.error.empty()) return;
    report.addTable("percent-counts.csv", resolution.counts);
    Places& places = data.value.groups;
    std::ranges::sort(places, {}, &Places::value_type::name);
    std::vector<std::string> responses, territories, counts, grids;
    for (auto& [name, trials] : places) {
        if (name.empty()) name = "all trials";
        const auto resolved = resolveCondition(name, trials);
        responses.push_back(responsesChart(report.nextFrame(name), resolved, trials));
        territories.push_back(territoryChart(report.nextFrame(name), resolved));
        counts.push_back(countsChart(report.nextFrame(name), resolved.counts));
        if (!resolved.resolution.ties.empty()) grids.push_back(mergedChart(report.nextFrame(name), resolved));
    }
    report.page.addFigure(responses,
                          "All responses, by colour and shape of the target, and one standard deviation of "
                          "each target's normal distribution" +
                              participantCountsText(places) + ".");
    report.page.addFigure({perceivedChart(report, places, false), perceivedChart(report, places, true)},
                          "Mean perceived column and row by the intended one" +
                              participantCountsText(places) + ".");
    report.page.addFigure(
        territories, "Likeliest target of each place. Numbers: row,column at the mean of its responses.");
    report.page.addFigure(counts,
                          "Percent counts: share of the field of which each target is the likeliest. Framed: "
                          "below 1.42 %.");
    if (!grids.empty())
        report.page.addFigure(grids, "Percent counts of the merged grid of the table, columns x rows.");
}

void addPlaceErrorsSection(ReportBuilder& report) {
    report.page.addHeading("Perceived places");
    report.page.addParagraph(
        std::string{hasEdges(report) ? "Places are shares of the named edges. "
                                     : "Places are in the table's units. "} +
        "Constant error: mean of answered minus true place. Variable error: standard deviation "
        "around a target's own mean, both axes together. Of each participant's targets the "
        "mean counts. Gain: slope of a participant's answered over true places, of all trials.");
    report.addAnalysis("places", report.options(), "places.csv");
}

} // namespace physvib
