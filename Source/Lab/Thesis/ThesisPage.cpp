// SPDX-License-Identifier: MIT
// Reads the rows from Source/Lab/Thesis/thesis.json; draws and reckons what needs no stimulus.
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

const std::vector<EmbeddedFile>& embeddedThesis(); // Source/Lab/Thesis

namespace {

const EmbeddedFile& thesisFile(std::string_view name) { // precondition: it is there
    return *std::ranges::find(embeddedThesis(), name, &EmbeddedFile::name);
}

std::string deviationsLeft(const std::string& study) {
    std::string words;
    for (const ThesisDeviation& one : deviationsOf(findProtocol(study + std::string{thesisSuffix}).value))
        words.append(words.empty() ? "" : "; ").append(one.thesis).append(": ").append(one.here);
    return words;
}

std::vector<ThesisRow> readRows(Json& json) {
    const JsonField list{json, {}};
    std::vector<ThesisRow> rows;
    for (std::size_t i = 0; i < list.arraySize(); ++i) {
        const JsonField row = list.item(i);
        row.expectObject({"at", "what", "run", "needs", "misprint", "differs", "study"});
        const auto text = [&](const char* name) {
            return row.has(name) ? row[name].text(1000) : std::string{};
        };
        rows.push_back(
            {text("at"), text("what"), text("run"), text("needs"), text("misprint"), text("differs")});
        if (row.has("study")) {
            std::string& differs = rows.back().differs;
            differs.append(differs.empty() ? "" : "; ").append(deviationsLeft(text("study")));
        }
    }
    return rows;
}

void tellTransfer(ThesisPage& out) {
    out.page.heading("Information transfer as printed (Fig. 3.11, 4.2)");
    out.page.paragraph(
        "The most that so many stimuli can transfer is log2 of their number. The least is Fano's inequality "
        "for the printed percent correct: an IT below it cannot have that percent correct.");
    ExportTable table{
        "thesis-transfer", false,
        "study,condition,criterion,stimuli,it_bits,most_bits,percent_correct,least_bits,two_to_it,possible"};
    for (const thesis::Identification& one : thesis::identifications) {
        const double most = std::log2(static_cast<double>(one.stimuli));
        const auto add = [&](std::size_t criterion, double bits, double percent) {
            if (bits <= 0.0) return;
            const double least = percent > 0.0 ? fanoBits(most, percent / 100.0, one.stimuli) : 0.0;
            table.cells(one.study, one.condition, criterion == 0 ? "exact" : "tolerance 1", one.stimuli, bits,
                        most);
            if (percent > 0.0)
                table.cells(percent, least);
            else
                table.cells("", "");
            table.row(std::exp2(bits),
                      bits <= most && bits >= least ? "yes" : "NO: below what its percent correct allows");
        };
        add(0, one.bits, one.percentCorrect);
        add(1, one.bitsTolerance, one.percentTolerance);
    }
    out.addTable("transfer.csv", table.text());
}

void tellCounts(ThesisPage& out) {
    out.page.heading("Percent counts as printed (Fig. 4.9), merged again");
    out.page.paragraph("Neighbouring rows and columns are merged until every cell reaches 1.42. The figure's "
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
                             thesis::countRows,
                             thesis::countColumns,
                             {printed.percent.begin(), printed.percent.end()}};
        const PerceptualResolution found = perceptualResolution(counts);
        const std::string merged = grid(found.columns, found.rows);
        table.row(printed.condition, counts.sum(), printed.deviation, counts.standardDeviation(),
                  grid(printed.columns, printed.rows), merged, found.ties.size());
        charts.push_back(countsChart(
            {"counts" + std::to_string(charts.size()), counts.condition + ": " + merged, false}, counts));
        all.push_back(std::move(counts));
    }
    out.addFigure("fig4-9", charts,
                  "Percent counts as printed (framed: below 1.42 %) and the largest grid that merging makes "
                  "of them, columns x rows.");
    out.addTable("resolutions.csv", table.text());
    out.files["percent-counts.csv"] =
        percentCountsCsv(all, {PHYSVIB_VERSION, {{"source", "thesis-Fig-4.9"}}});
}

/// The table of tests in the script, which alone has it: Table 4.1 and the others, as printed.
void tellTests(ThesisPage& out) {
    const std::string_view script = thesisFile("printed-tests.R").text;
    out.files["printed-tests.R"] = script;
    const std::size_t from = script.find("where;"), to = script.find("\")", from);
    std::string csv{script.substr(from, to - from)};
    csv += '\n';
    out.page.heading("Table 4.1 and the other printed tests");
    out.page.paragraph("Rscript printed-tests.R reckons each p from its statistic: four of forty are printed "
                       "otherwise. F is not reckoned from means, as no mean has its deviation beside it, nor "
                       "information transfer from counts, as no confusion matrix is printed.");
    out.addTable("printed-tests.csv", csv);
}

} // namespace

const std::vector<ThesisRow>& thesisRows() {
    static const auto read = [](std::string_view text, std::string_view name) {
        return readJson(text, name, limits::maxProtocolFileBytes, readRows);
    };
    static const auto rows = readEmbedded({thesisFile("thesis.json")}, read).front();
    return rows;
}

void ThesisPage::addFigure(const std::string& name, const std::vector<std::string>& charts,
                           const std::string& caption) {
    files[name + ".svg"] = chartSheet(charts);
    page.figure(charts, caption);
}

ThesisPage thesisPage() {
    ThesisPage out{ReportPage{"The thesis, and where it is in PhysVib", false,
                              "Printed figures are the thesis'; all drawings are ours."}};
    out.page.paragraph("Each call runs in a folder of its own, in this order: some read what others wrote. "
                       "Studies are rehearsed by a simulated observer.");
    ExportTable rows{"thesis", false, "at,what,run,needs,misprint,differs"};
    for (const ThesisRow& row : thesisRows())
        rows.row(row.at, row.what, row.run, row.needs, row.misprint, row.differs);
    out.addTable("thesis.csv", rows.text());
    out.page.heading("Modules (3.1.1)");
    for (const auto& [name, caption] :
         {std::pair{"fig3-1",
                    "Actuators and layers in the printed sizes; cases, pads and rings have none in print."},
          {"fig3-2", "How the scales lie to each other is no conversion."},
          {"fig3-3", "`physvib attenuation` takes such recordings and draws Fig. 3.5; isolation-tests.R "
                     "draws Fig. 3.4."}})
        out.addFigure(name, {std::string{thesisFile(std::string{name} + ".svg").text}}, caption);
    out.files["isolation-tests.R"] = thesisFile("isolation-tests.R").text;
    tellTransfer(out);
    tellCounts(out);
    tellTests(out);
    return out;
}

} // namespace physvib
