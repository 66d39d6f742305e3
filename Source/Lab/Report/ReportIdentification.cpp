// SPDX-License-Identifier: MIT
// Report sections on identification (information transfer, percent correct) and on pointing.
#include "Io/Text/NumberText.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/StudyCsv.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>

namespace physvib {
namespace {

using Identified = StudyData<IdentificationTrial>;

struct IdentifiedCondition {
    std::string condition;
    ConfusionMatrix matrix;
    InformationTransfer transfer;
    std::vector<double> shares, bits; ///< one value per participant, in percent and bits
    bool isCorrected = true;          ///< all of `bits`

    /// Mean percent correct with its interval, cut at 0 and 100 %.
    ChartValue correct() const {
        const Moments moments{shares};
        return {moments.mean, std::max(0.0, moments.least()), std::min(100.0, moments.most())};
    }
    bool isCut() const { return Moments(shares).least() < 0.0 || Moments(shares).most() > 100.0; }
};

std::vector<IdentifiedCondition> conditionsOf(const Identified& data, int tolerance) {
    std::vector<IdentifiedCondition> all;
    for (const auto& condition : data.conditions) {
        const auto trials = tolerance == 0 ? condition.trials : withTolerance(condition.trials, tolerance);
        const ConfusionMatrix matrix{trials};
        IdentifiedCondition one{condition.name.empty() ? "all trials" : condition.name,
                                matrix,
                                informationTransfer(matrix),
                                {},
                                {}};
        for (const auto& own : comparable(transferByParticipant(trials), matrix.stimuli())) {
            one.shares.push_back(100.0 * static_cast<double>(own.matrix.correct()) /
                                 static_cast<double>(own.matrix.trials()));
            if (own.matrix.stimuli() != matrix.stimuli()) continue;
            one.bits.push_back(own.transfer.bestBits());
            one.isCorrected = one.isCorrected && own.transfer.canBeCorrected();
        }
        all.push_back(std::move(one));
    }
    return all;
}

/// One bar per condition, with the value that `value` returns.
template <class Value>
BarChart barsOf(ChartFrame frame, const char* words, const std::vector<IdentifiedCondition>& all,
                Value value) {
    BarChart chart{std::move(frame), "condition", words};
    for (const IdentifiedCondition& one : all) chart.add(one.condition, value(one));
    return chart;
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
    GridChart chart{report.frame(condition.condition + (tolerance ? ", 1 step of tolerance" : "")),
                    "row",
                    "column",
                    {},
                    {},
                    {}};
    chart.most = 100.0;
    chart.width = 225.0;
    for (int r = 1; r <= rows; ++r) chart.rows.push_back(std::to_string(r));
    for (int c = 1; c <= columns; ++c) chart.columns.push_back(std::to_string(c));
    chart.values.resize(static_cast<std::size_t>(rows * columns));
    chart.halfIntervals.resize(chart.values.size());
    std::map<std::string, std::vector<double>> shares; // by stimulus
    for (const auto& own : transferByParticipant(trials))
        for (std::size_t i = 0; i < own.matrix.stimuli(); ++i)
            shares[own.matrix.label(i)].push_back(100.0 * shareCorrect(own.matrix, i));
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto at = static_cast<std::size_t>((cells[i].row - 1) * columns + cells[i].column - 1);
        const Moments moments{shares[condition.matrix.label(i)]};
        chart.values[at] = moments.mean;
        chart.halfIntervals[at] = moments.halfInterval();
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
    report.page.subheading(tolerance ? "With one step of tolerance" : "Exact answers");
    const AnalysisReport confusion = report.analysis("confusion", options, "confusion" + suffix + ".csv");
    if (!confusion.error.empty()) return;
    const std::string values = "identification" + suffix + ".csv";
    report.addTable(values, confusion.participants);
    const auto all = conditionsOf(data, tolerance);
    const bool hasPeople = all.front().shares.size() > 1;
    BarChart it = barsOf(report.frame("Information transfer" + words), "IT (bit)", all,
                         [](const auto& c) { return ChartValue::around(c.transfer.bits); });
    for (const IdentifiedCondition& one : all) it.ceilings.push_back(one.transfer.mostBits);
    it.ceilingWords = "most possible";
    report.page.figure(
        {barChart(it)},
        "Information transfer of all participants' trials together, not corrected" + words +
            report.asThesis("Fig. 3.11, 4.2") +
            ": one estimate per condition, so it has no interval. Dotted: log2 of the number of stimuli.");
    if (hasPeople && std::ranges::none_of(all, [](const auto& c) { return c.bits.empty(); })) {
        auto own = barsOf(report.frame("Information transfer of participants" + words), "IT (bit)", all,
                          [](const auto& c) {
                              return ChartValue::around(Moments(c.bits).mean, Moments(c.bits).halfInterval());
                          });
        const bool isCorrected = std::ranges::all_of(all, &IdentifiedCondition::isCorrected);
        own.ceilings = it.ceilings, own.ceilingWords = it.ceilingWords;
        report.page.figure({barChart(own)},
                           "Mean of the participants' own information transfer" + words + report.intervals() +
                               ", without those who lack a stimulus." +
                               (isCorrected ? ""
                                            : " Few trials make those that are not corrected "
                                              "too high: compare conditions of as many "
                                              "stimuli and trials only."));
    }
    const auto isOfAll = [](const auto& c) { return c.shares.size() > c.bits.size(); };
    BarChart pc = barsOf(report.frame("Percent correct" + words), "correct (%)", all,
                         [](const auto& c) { return c.correct(); });
    pc.most = 100.0;
    report.page.figure(
        {barChart(pc)},
        "Mean percent correct" + words + report.asThesis("Fig. 3.12, 4.3") + report.intervals() +
            (std::ranges::any_of(all, &IdentifiedCondition::isCut) ? ", cut at 0 and 100 %" : "") +
            (std::ranges::any_of(all, isOfAll) ? ", each of the stimuli that there are."
                                               : ", without those who lack a stimulus."));
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
    report.page.figure(
        charts,
        isGrid(data)
            ? "Percent correct by place" + words + report.asThesis("Fig. 4.4") + report.intervals() +
                  (hasPeople
                       ? " where there is room, cut at 0 and 100 %, and none where all have the same share."
                       : ".")
            : "Confusions: rows are stimuli, columns responses, darker is a larger share of the "
              "stimulus' trials. Where labels have no room every second, third ... is shown.");
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
                    isRow ? "perceived, share of the height" : "perceived, share of the width",
                    {}};
    chart.width = 335.0;
    chart.height = 330.0;
    chart.yRange = {0.0, 1.0};
    for (std::size_t i = 0; i < places.size(); ++i) {
        std::map<int, std::map<std::string, std::vector<double>>> answers; // by target and participant
        for (const LocationTrial& trial : places[i].trials)
            answers[isRow ? trial.targetRow : trial.targetColumn][trial.participant].push_back(
                isRow ? trial.y : trial.x);
        LineSeries series{places[i].name, {}};
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
        const auto outside = std::ranges::count_if(
            report.trials.all.rows, [&](const CsvRow& row) { return lies(row, "x") || lies(row, "y"); });
        tellPlaceErrors(report);
        return report.page.note(
            std::to_string(outside) + " of " + counted(report.trials.all.rows.size(), "place") +
            (hasEdges(report) ? " lie beyond the edges that --columns names" : " lie outside 0 to 1") +
            ", so nothing is shown of territories and grids, which need all within the field's edges" +
            (hasEdges(report)
                 ? ""
                 : ": name these (--columns x=COLUMN:LEFT:RIGHT,y=COLUMN:TOP:BOTTOM, targets likewise)"));
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
                       "Every response (coloured by target, shaped by its row) and the normal distribution "
                       "of each target's responses (ellipses of one standard deviation)" +
                           report.asThesis("Fig. 4.6") + ".");
    report.page.figure({perceivedChart(report, places, false), perceivedChart(report, places, true)},
                       "Mean perceived column and row against the intended one" +
                           report.asThesis("Fig. 4.7") + report.intervals() + ".");
    report.page.figure(territories,
                       "The likeliest target of every place" + report.asThesis("Fig. 4.8") +
                           ". Numbers, row,column of the target, stand at the mean of its responses; where "
                           "one lies in another's territory, it is not told apart.");
    report.page.figure(counts, "Percent counts: the share of the field that each target is likeliest for" +
                                   report.asThesis("Fig. 4.9 a") + ". Framed: below 1.42 %.");
    if (!grids.empty())
        report.page.figure(grids, "Neighbouring rows and columns merged until every cell reaches 1.42 %" +
                                      report.asThesis("Fig. 4.9 b") +
                                      ": the perceptual resolution, columns x rows.");
}

void tellPlaceErrors(ReportBuilder& report) {
    report.page.heading("Perceived places");
    report.page.paragraph(
        std::string{
            hasEdges(report)
                ? "Places are shares of the named edges, x of the width and y of the height: where these "
                  "differ, so do the units of x and y in distances and variable errors. "
                : "Places in the table's own units. "} +
        "Constant error: mean of answered minus true place. "
        "Variable error: standard deviation around a target's own mean, both axes together. Gain: slope of "
        "answered over true places; 1 is neither drawn together nor apart. Means over participants of their "
        "means over targets; each target counts as much.");
    report.analysis("places", report.options(), "places.csv");
}

} // namespace physvib
