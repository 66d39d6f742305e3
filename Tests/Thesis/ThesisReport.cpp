// SPDX-License-Identifier: MIT
// First what the print says of itself, then what simulated people make of the same studies.
#include "Thesis/ThesisReport.h"
#include "Io/Charts/Charts.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Report/ReportBuilder.h"
#include "Lab/Report/StudyReport.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/Places.h"
#include "Support/Studies.h"
#include "Thesis/Printed.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

constexpr const char* observerName = "simulated-thesis";

/// The trials of that built-in protocol, of so many participants who answer as `observer` does: the same rows
/// as `study run` writes, marked as simulated.
ReportTrials rehearse(const std::string& name, const std::string& observer, int participants) {
    const Protocol protocol = findProtocol(name).value;
    std::vector<std::pair<std::string, std::string>> texts;
    for (int number = 1; number <= participants; ++number) {
        const std::string code = (number < 10 ? "P0" : "P") + std::to_string(number);
        const Participant participant{code, number, observer};
        texts.emplace_back(name + "-" + code + ".csv",
                           trialFile(protocol, participant,
                                     answered(protocol, participant, *observerNamed(observer)),
                                     PHYSVIB_VERSION));
    }
    return readReportTrials(texts, {}, protocol).value;
}

class RehearsalPage {
public:
    std::map<std::string, std::string> files() {
        tellBlur();
        tellRehearsals();
        page_.addHeading("Files");
        std::vector<std::string> names;
        for (const auto& [name, text] : files_)
            if (name.find('/') == std::string::npos) names.push_back(name);
        page_.addList(names);
        page_.addParagraph(std::string("physvib ") + PHYSVIB_VERSION +
                           "; seeds of rehearsals: those of the protocols.");
        std::string html = page_.html();
        for (const thesis::Participants& study : thesis::participants) {
            const std::string name = std::string{study.protocol} + "/index.html";
            if (const auto at = html.find(name); at != std::string::npos)
                html.replace(at, name.size(), "<a href=\"" + name + "\">" + name + "</a>");
        }
        files_["index.html"] = std::move(html);
        return std::move(files_);
    }

private:
    std::string chartName() { return "thesis" + std::to_string(++charts_); }
    void addTable(const std::string& name, const ExportTable& table, std::size_t mostRows = 60) {
        files_[name] = table.text();
        page_.addTable(table.text(), name, mostRows);
    }
    void tellBlur();
    void tellRehearsals();
    void compareIdentification(const ReportTrials& trials, std::string_view study);
    void comparePlaces(const ReportTrials& trials);
    void compareChoices(const ReportTrials& trials);
    void compareRatings(const ReportTrials& trials);
    std::string besideChart(const std::string& title, const std::string& words,
                            const std::vector<std::string>& groups,
                            const std::vector<std::optional<double>>& printed,
                            const std::vector<std::optional<double>>& rehearsed, std::optional<double> most);

    ReportPage page_{"The thesis rehearsed: what is printed beside five rehearsals", false,
                     "Printed figures are the thesis'. Everything called rehearsed is SIMULATED: an observer "
                     "fitted to the printed figures answered, not a person."};
    std::map<std::string, std::string> files_;
    int charts_ = 0;
};

void RehearsalPage::tellBlur() {
    page_.addHeading("Percent correct as printed (Fig. 4.3), and one blur that explains it");
    page_.addParagraph(
        "One normal blur of places per configuration, fitted to the exact shares of three grids, "
        "predicts the shares with tolerance that it was not shown.");
    ExportTable table{"thesis-blur", false,
                      "configuration,blur,grid,exact_printed,exact_fitted,tolerance_1_printed,tolerance_1_"
                      "predicted,it_printed,it_model,it_tolerance_1_printed,it_tolerance_1_model"};
    for (const std::string_view configuration : {"PHONE", "RING"}) {
        const double blur = thesis::printedBlur(configuration);
        for (const auto& one : thesis::identifications) {
            if (one.study != "phantom-grids" || !one.condition.starts_with(configuration)) continue;
            const BlurredGrid model = blurredGrid(thesis::linesOf(one), blur);
            table.row(configuration, blur, one.condition.substr(one.condition.find('-') + 1),
                      one.percentCorrect, 100.0 * model.shareExact, one.percentTolerance,
                      100.0 * model.shareTolerance1, one.bits, model.bits, one.bitsTolerance,
                      model.bitsTolerance1);
        }
    }
    addTable("blur.csv", table);
}

std::string RehearsalPage::besideChart(const std::string& title, const std::string& words,
                                       const std::vector<std::string>& groups,
                                       const std::vector<std::optional<double>>& printed,
                                       const std::vector<std::optional<double>>& rehearsed,
                                       std::optional<double> most) {
    const auto bars = [](const std::vector<std::optional<double>>& values) {
        std::vector<std::optional<ChartValue>> all;
        for (const auto& value : values)
            all.push_back(value ? std::optional{ChartValue{*value, *value, *value}} : std::nullopt);
        return all;
    };
    BarChart chart{{chartName(), title, true},
                   "condition",
                   words,
                   groups,
                   {{"printed", bars(printed)}, {"rehearsed (simulated)", bars(rehearsed)}}};
    chart.max = most;
    return barChart(chart);
}

void RehearsalPage::compareIdentification(const ReportTrials& trials, std::string_view study) {
    const auto data = readOne(readIdentification, trialsCsv(trials, ""));
    for (const int tolerance : {0, 1}) {
        if (tolerance == 1 && study != "phantom-grids") continue;
        std::vector<std::string> groups;
        std::vector<std::optional<double>> bits, rehearsedBits, correct, rehearsedCorrect;
        for (const auto& one : thesis::identifications) {
            if (one.study != study) continue;
            const auto found =
                std::ranges::find(data.value.groups, one.condition, &TrialGroup<IdentificationTrial>::name);
            const ConfusionMatrix matrix{tolerance ? tolerate(found->trials, tolerance) : found->trials};
            groups.emplace_back(one.condition);
            bits.emplace_back(tolerance ? one.bitsTolerance : one.bits);
            rehearsedBits.emplace_back(informationTransfer(matrix).bits);
            const double percent = tolerance ? one.percentTolerance : one.percentCorrect;
            correct.push_back(percent > 0.0 ? std::optional{percent} : std::nullopt);
            rehearsedCorrect.emplace_back(100.0 * static_cast<double>(matrix.correct()) /
                                          static_cast<double>(matrix.trials()));
        }
        const std::string words = tolerance ? ", 1 step of tolerance" : "";
        page_.addFigure(
            {besideChart("Information transfer" + words, "IT (bit)", groups, bits, rehearsedBits,
                         std::nullopt),
             besideChart("Percent correct" + words, "correct (%)", groups, correct, rehearsedCorrect, 100.0)},
            study == "patterns" ? "As Fig. 3.11 and 3.12. Percent correct is printed as 89.2 to 95.0 %, mean "
                                  "92.1 %, without saying which."
                                : "As Fig. 4.2 and 4.3" + words +
                                      ". With tolerance people err farther than a normal blur does.");
    }
}

void RehearsalPage::comparePlaces(const ReportTrials& trials) {
    const auto data = readOne(readLocations, trialsCsv(trials, ""));
    ExportTable table{"thesis-resolutions-rehearsed", true,
                      "condition,grid_printed,deviation_printed,grid_rehearsed,deviation_rehearsed"};
    for (const thesis::Counts& printed : thesis::counts) {
        const auto found =
            std::ranges::find(data.value.groups, printed.condition, &TrialGroup<LocationTrial>::name);
        const ConditionResolution made = resolveCondition(found->name, found->trials);
        const auto grid = [](const auto& of) {
            return std::to_string(of.columns) + " x " + std::to_string(of.rows);
        };
        table.row(printed.condition, grid(printed), printed.deviation, grid(made.resolution),
                  made.counts.standardDeviation());
    }
    page_.addParagraph(
        "The observer's blur is that of 4.1 and the same everywhere; it knows nothing of laws, nor of places "
        "where people feel phantoms elsewhere, so its territories are more alike than people's.");
    addTable("resolutions-rehearsed.csv", table);
}

void RehearsalPage::compareChoices(const ReportTrials& trials) {
    const auto data = readOne(readChoices, trialsCsv(trials, ""));
    const ChoiceSummary all = summariseChoices(data.value.groups.front().trials).front();
    ExportTable table{"thesis-choices-rehearsed", true, "measure,printed,rehearsed"};
    table.row("model chosen, %", thesis::modelChosenPercent, 100.0 * all.shares.front().share);
    addTable("choices-rehearsed.csv", table);
}

void RehearsalPage::compareRatings(const ReportTrials& trials) {
    const auto data = readOne(readRatings, trialsCsv(trials, ""));
    const auto summaries = summariseRatings(data.value.groups.front().trials);
    std::vector<std::string> groups;
    std::vector<std::optional<double>> printed, rehearsed;
    for (const thesis::Rating& rating : thesis::ratings) {
        const auto found = std::ranges::find(summaries, rating.method, &RatingSummary::condition);
        for (std::size_t s = 0; s < rating.scores.size(); ++s) {
            groups.push_back(std::string(rating.method) + " " + data.value.scales[s]);
            printed.emplace_back(rating.scores[s]);
            rehearsed.emplace_back(found->means[s]);
        }
    }
    page_.addFigure(
        {besideChart("Mean scores", "mean score (0 to 100)", groups, printed, rehearsed, 100.0)},
        "As Fig. 5.14, the three methods whose scores are printed. The observer's scales differ by "
        "chance alone.");
}

void RehearsalPage::tellRehearsals() {
    page_.addHeading("Five rehearsals (SIMULATED)");
    page_.addParagraph(
        std::string(
            "The built-in protocols with as many participants as the thesis had, answered by the observer ") +
        observerName +
        ": its place blurs are fitted to the exact shares of 4.1.2, its confusions of pulses to the mean "
        "percent correct of 3.2.2, its preference to the votes of 5.2.2, its scores to the gains of 5.3.2, "
        "and how much participants "
        "differ to the printed statistics. Each rehearsal has a report of its own, as `physvib report` makes "
        "it of people's trials.");
    for (const thesis::Participants& study : thesis::participants) {
        const std::string name{study.protocol};
        const ReportTrials trials = rehearse(name, observerName, study.count);
        page_.addSubheading(trials.protocol->title);
        const StudyReport report = studyReport(trials);
        for (const auto& [file, text] : report.files) files_[name + "/" + file] = text;
        page_.addList({name + "/index.html: " + std::to_string(study.count) + " simulated participants, " +
                       std::to_string(report.tests.size()) + " tests"});
        if (name == "patterns" || name == "phantom-grids") compareIdentification(trials, name);
        if (name == "phantom-places") comparePlaces(trials);
        if (name == "model-or-sound") compareChoices(trials);
        if (name == "eight-methods") compareRatings(trials);
    }
}

} // namespace

std::map<std::string, std::string> thesisReport() { return RehearsalPage{}.files(); }

} // namespace physvib
