// SPDX-License-Identifier: MIT
// Reads the rows from Source/Lab/Thesis/thesis.json; draws the page and computes what needs no stimulus.
#include "Lab/Thesis/ThesisPage.h"
#include "Io/Charts/Charts.h"
#include "Io/Disk/Embedded.h"
#include "Io/Json/JsonText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Identification.h"
#include <algorithm>
#include <cmath>

namespace physvib {

const std::vector<EmbeddedFile>& embeddedThesis(); // files of Source/Lab/Thesis

namespace {

const EmbeddedFile& thesisFile(std::string_view name) { // precondition: the file exists
    return *std::ranges::find(embeddedThesis(), name, &EmbeddedFile::name);
}

std::string remainingDeviations(const std::string& study) {
    std::string words;
    for (const ThesisDeviation& deviation :
         findDeviations(findProtocol(study + std::string{thesisSuffix}).value))
        words.append(words.empty() ? "" : "; ")
            .append(deviation.inThesis)
            .append(": ")
            .append(deviation.inProtocol);
    return words;
}

std::vector<ThesisEntry> readRows(Json& json) {
    const JsonField list{json, {}};
    std::vector<ThesisEntry> rows;
    for (std::size_t i = 0; i < list.arraySize(); ++i) {
        const JsonField row = list.item(i);
        row.expectObject({"at", "what", "run", "needs", "misprint", "differs", "study"});
        const auto text = [&](const char* name) {
            return row.has(name) ? row[name].text(1000) : std::string{};
        };
        rows.push_back(
            {text("at"), text("what"), text("run"), text("needs"), text("misprint"), text("differs")});
        if (row.has("study")) {
            std::string& difference = rows.back().difference;
            difference.append(difference.empty() ? "" : "; ").append(remainingDeviations(text("study")));
        }
    }
    return rows;
}

void addTransferSection(ThesisPage& result) {
    result.page.addHeading("Information transfer as printed (Fig. 3.11, 4.2)");
    result.page.addParagraph(
        "The most that so many stimuli can transfer is log2 of their number. The least is Fano's inequality "
        "for the printed percent correct: an IT below it cannot have that percent correct.");
    ExportTable table{
        "thesis-transfer", false,
        "study,condition,criterion,stimuli,it_bits,most_bits,percent_correct,least_bits,two_to_it,possible"};
    for (const thesis::Identification& row : thesis::identifications) {
        const double maxBits = std::log2(static_cast<double>(row.stimuli));
        const auto add = [&](std::size_t criterion, double bits, double percent) {
            if (bits <= 0.0) return;
            const double minBits = percent > 0.0 ? fanoBits(maxBits, percent / 100.0, row.stimuli) : 0.0;
            table.cells(row.study, row.condition, criterion == 0 ? "exact" : "tolerance 1", row.stimuli, bits,
                        maxBits);
            if (percent > 0.0)
                table.cells(percent, minBits);
            else
                table.cells("", "");
            table.row(std::exp2(bits), bits <= maxBits && bits >= minBits
                                           ? "yes"
                                           : "NO: below what its percent correct allows");
        };
        add(0, row.bits, row.percentCorrect);
        add(1, row.bitsTolerance, row.percentTolerance);
    }
    result.addTable("transfer.csv", table.text());
}

void addCountsSection(ThesisPage& result) {
    result.page.addHeading("Percent counts as printed (Fig. 4.9), merged again");
    result.page.addParagraph(
        "Neighbouring rows and columns are merged until every cell reaches 1.42. The figure's "
        "tables are in another order than its captions: sample standard deviations tell which "
        "is which. The abstract's 6 x 5 and 6 x 4 for RING contradict them.");
    ExportTable table{"thesis-percent-counts", false,
                      "condition,sum,deviation_printed,deviation,grid_printed,grid,ties"};
    const auto grid = [](std::size_t columns, std::size_t rows) {
        return std::to_string(columns) + " x " + std::to_string(rows);
    };
    std::vector<PercentCounts> all;
    std::vector<std::string> charts;
    for (const thesis::Counts& printed : thesis::counts) {
        PercentCounts counts{std::string(printed.condition),
                             thesis::printedRows,
                             thesis::printedColumns,
                             {printed.percent.begin(), printed.percent.end()}};
        const PerceptualResolution found = perceptualResolution(counts);
        const std::string merged = grid(found.columns, found.rows);
        table.row(printed.condition, counts.sum(), printed.deviation, counts.standardDeviation(),
                  grid(printed.columns, printed.rows), merged, found.ties.size());
        charts.push_back(countsChart(
            {"counts" + std::to_string(charts.size()), counts.condition + ": " + merged, false}, counts));
        all.push_back(std::move(counts));
    }
    result.addFigure(
        "fig4-9", charts,
        "Percent counts as printed (framed: below 1.42 %) and the largest grid that merging makes "
        "of them, columns x rows.");
    result.addTable("resolutions.csv", table.text());
    result.files["percent-counts.csv"] =
        percentCountsCsv(all, {PHYSVIB_VERSION, {{"source", "thesis-Fig-4.9"}}});
}

/// Adds Table 4.1 and the other printed tests, read from the script that alone contains them.
void addTestsSection(ThesisPage& result) {
    const std::string_view script = thesisFile("printed-tests.R").text;
    result.files["printed-tests.R"] = script;
    const std::size_t from = script.find("where;"), to = script.find("\")", from);
    std::string csv{script.substr(from, to - from)};
    csv += '\n';
    result.page.addHeading("Table 4.1 and the other printed tests");
    result.page.addParagraph(
        "Rscript printed-tests.R reckons each p from its statistic: four of forty are printed "
        "otherwise. F is not reckoned from means, as no mean has its deviation beside it, nor "
        "information transfer from counts, as no confusion matrix is printed.");
    result.addTable("printed-tests.csv", csv);
}

} // namespace

const std::vector<ThesisEntry>& thesisEntries() {
    static const auto read = [](std::string_view text, std::string_view name) {
        return readJson(text, name, limits::maxProtocolFileBytes, readRows);
    };
    static const auto rows = readEmbedded({thesisFile("thesis.json")}, read).front();
    return rows;
}

void ThesisPage::addFigure(const std::string& name, const std::vector<std::string>& charts,
                           const std::string& caption) {
    files[name + ".svg"] = chartSheet(charts);
    page.addFigure(charts, caption);
}

ThesisPage thesisPage() {
    ThesisPage result{ReportPage{"The thesis, and where it is in PhysVib", false,
                                 "Printed figures are the thesis'; all drawings are ours."}};
    result.page.addParagraph(
        "Each call runs in a folder of its own, in this order: some read what others wrote. "
        "Studies are rehearsed by a simulated observer.");
    ExportTable rows{"thesis", false, "at,what,run,needs,misprint,differs"};
    for (const ThesisEntry& row : thesisEntries())
        rows.row(row.sections, row.subject, row.call, row.requirements, row.misprint, row.difference);
    result.addTable("thesis.csv", rows.text());
    result.page.addHeading("Modules (3.1.1)");
    for (const auto& [name, caption] :
         {std::pair{"fig3-1",
                    "Actuators and layers in the printed sizes; cases, pads and rings have none in print."},
          {"fig3-2", "How the scales lie to each other is no conversion."},
          {"fig3-3", "`physvib attenuation` takes such recordings and draws Fig. 3.5; isolation-tests.R "
                     "draws Fig. 3.4."}})
        result.addFigure(name, {std::string{thesisFile(std::string{name} + ".svg").text}}, caption);
    result.files["isolation-tests.R"] = thesisFile("isolation-tests.R").text;
    addTransferSection(result);
    addCountsSection(result);
    addTestsSection(result);
    return result;
}

} // namespace physvib
