// SPDX-License-Identifier: MIT
// Reads the rows from Source/Lab/Thesis/thesis.json; draws and reckons what needs no stimulus.
#include "Lab/Thesis/ThesisPage.h"
#include "Io/Charts/ChartParts.h"
#include "Io/Charts/Charts.h"
#include "Io/Disk/Embedded.h"
#include "Io/Json/JsonText.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Files/ProtocolFile.h"
#include "Lab/Study/Identification.h"
#include "Lab/Study/PercentCounts.h"
#include "Lab/Thesis/Published.h"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace physvib {

const std::vector<EmbeddedFile>& embeddedThesis(); // Source/Lab/Thesis: thesis.json, printed-tests.R

namespace {

const EmbeddedFile& thesisFile(std::string_view name) {
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
        row.expectObject({"at", "what", "run", "needs", "differs", "study"});
        const auto text = [&](const char* name) {
            return row.has(name) ? row[name].text(1000) : std::string{};
        };
        rows.push_back({text("at"), text("what"), text("run"), text("needs"), text("differs")});
        if (row.has("study")) {
            std::string& differs = rows.back().differs;
            differs.append(differs.empty() ? "" : "; ").append(deviationsLeft(text("study")));
        }
    }
    return rows;
}

// Figures 3.1 to 3.3 as sketches: sizes in mm as printed, all else as a drawing needs it.

constexpr std::string_view metal = "#cfd4da", silicone = "#f3c9a5", skin = "#eef1f4", ink = "#222";

std::string modulesDrawing() {
    struct Actuator {
        const char *name, *size;
        double wide, high; // mm
        bool isIsolated;
    };
    constexpr std::array actuators{
        Actuator{"coin LRA, 205 Hz, on a phone", "9 x 3.4 mm", 9.0, 3.4, true},
        Actuator{"piezo cantilever, 230 Hz, on a phone", "35 x 3.8 x 3.2 mm", 35.0, 3.2, true},
        Actuator{"Haptuator Mark II, 90 to 1000 Hz", "32 x 9 x 9 mm", 32.0, 9.0, true},
        Actuator{"coin LRA in a ring", "9 x 3.4 mm", 9.0, 3.4, false}};
    constexpr double scale = 5.0, width = 680.0, column = width / 2.0, row = 170.0;
    Svg svg{"modules", width, 40.0 + 2.0 * row};
    detail::drawTitle(svg, "Fig. 3.1, sketched: modules, 5 pixels a millimetre", width);
    for (std::size_t i = 0; i < actuators.size(); ++i) {
        const Actuator& one = actuators[i];
        const double middle = column * (static_cast<double>(i % 2) + 0.5),
                     top = 40.0 + row * static_cast<double>(i / 2);
        const auto box = [&](double y, double wide, double high, std::string_view fill, const char* words) {
            svg.rect({middle - 0.5 * wide, y}, wide, high, fill, {ink, 1.0});
            if (words != nullptr) svg.text({middle, y + 0.5 * high + 4.0}, words, {11.0, Anchor::middle});
        };
        svg.text({middle, top + 16.0}, std::string{one.name} + ", " + one.size, {12.0, Anchor::middle});
        const double high = one.high * scale, wide = one.wide * scale, bottom = top + 74.0;
        box(bottom - high, wide, high, metal, nullptr);
        if (one.isIsolated) {
            const double layer = 3.0 * scale, broad = std::max(wide + 20.0, 190.0);
            box(bottom, broad, layer, silicone, "0030 silicone, 15 % softener, 3 mm");
            box(bottom + layer, broad, 14.0, "#b9d7b4", "anti-slip silicone pad");
            box(bottom + layer + 14.0, broad + 60.0, 22.0, skin, "phone");
        } else {
            box(bottom, 14.0, 16.0, metal, nullptr);
            box(bottom - 3.0, 44.0, 6.0, metal, nullptr);
            svg.text({middle + 30.0, bottom + 9.0}, "T-shaped adaptor", {11.0});
            svg.ellipse({middle, bottom + 46.0}, 44.0, 32.0, 0.0, "#555", {ink, 1.0});
            svg.ellipse({middle, bottom + 46.0}, 34.0, 23.0, 0.0, skin, {ink, 1.0});
            svg.text({middle, bottom + 50.0}, "finger", {11.0, Anchor::middle});
            svg.text({middle + 52.0, bottom + 50.0}, "soft printed ring", {11.0});
        }
    }
    return svg.finish("Three modules on a phone and one in a ring, with layer and pad", false);
}

std::string hardnessDrawing() {
    constexpr double width = 680.0, left = 90.0, unit = 4.6;
    Svg svg{"hardness", width, 232.0};
    detail::drawTitle(svg, "Fig. 3.2, sketched: Shore scales, one beside the other", width);
    struct Scale {
        const char *name, *words;
        double from, to; // shares of the drawing: how scales lie to each other is no conversion
    };
    constexpr std::array scales{Scale{"Shore 00", "gel, very soft rubber", 0.0, 72.0},
                                Scale{"Shore A", "mould rubber, semi-rigid plastic", 34.0, 104.0},
                                Scale{"Shore D", "hard rubber, hard plastic", 70.0, 122.0}};
    for (std::size_t i = 0; i < scales.size(); ++i) {
        const Scale& one = scales[i];
        const double y = 56.0 + 56.0 * static_cast<double>(i), from = left + one.from * unit,
                     wide = (one.to - one.from) * unit;
        svg.text({14.0, y + 14.0}, one.name, {12.0, Anchor::start, 0.0, true});
        svg.rect({from, y}, wide, 20.0, i == 0 ? silicone : i == 1 ? "#e3d3ea" : metal, {ink, 1.0});
        svg.text({from + 0.5 * wide + (i == 0 ? 60.0 : 0.0), y + 14.0}, one.words, {11.0, Anchor::middle});
        for (int tick = 0; tick <= 100; tick += 20) {
            const double x = from + wide * tick / 100.0;
            svg.line({x, y + 20.0}, {x, y + 25.0});
            svg.text({x, y + 36.0}, std::to_string(tick), {11.0, Anchor::middle});
        }
    }
    for (const double mark : {10.0, 30.0}) { // the two silicones of 3.1.1
        const double x = left + 72.0 * unit * mark / 100.0;
        svg.line({x, 44.0}, {x, 76.0}, {"#c0392b", 2.0});
        svg.text({x, 40.0}, mark == 10.0 ? "0010" : "0030", {11.0, Anchor::middle, 0.0, false, "#c0392b"});
    }
    return svg.finish("Shore 00, A and D overlap; 0010 and 0030 lie at 10 and 30 of Shore 00", false);
}

std::string setupDrawing() {
    constexpr double width = 680.0;
    Svg svg{"setup", width, 210.0};
    detail::drawTitle(svg, "Fig. 3.3, sketched: what a layer holds back is measured", width);
    svg.rect({120.0, 140.0}, 340.0, 26.0, skin, {ink, 1.0});
    svg.text({290.0, 158.0}, "phone", {12.0, Anchor::middle});
    svg.rect({170.0, 122.0}, 130.0, 18.0, silicone, {ink, 1.0});
    svg.text({235.0, 135.0}, "layer", {11.0, Anchor::middle});
    svg.rect({170.0, 70.0}, 130.0, 52.0, metal, {ink, 1.0});
    svg.text({235.0, 92.0}, "Haptuator,", {11.0, Anchor::middle});
    svg.text({235.0, 106.0}, "turned along x, y, z", {11.0, Anchor::middle});
    svg.rect({340.0, 116.0}, 24.0, 24.0, "#333", {ink, 1.0});
    svg.text({376.0, 122.0}, "accelerometer, three axes: A", {11.0});
    svg.line({235.0, 70.0}, {235.0, 58.0}, {"#c0392b", 1.5});
    svg.text({244.0, 56.0}, "reference: on the module itself", {11.0, Anchor::start, 0.0, false, "#c0392b"});
    for (const auto& [to, words, at] : {std::tuple{ChartPoint{595.0, 140.0}, "x", ChartPoint{600.0, 144.0}},
                                        {ChartPoint{555.0, 100.0}, "z", ChartPoint{551.0, 94.0}},
                                        {ChartPoint{580.0, 118.0}, "y", ChartPoint{584.0, 116.0}}}) {
        svg.line({555.0, 140.0}, to, {ink, 1.5});
        svg.text(at, words, {12.0});
    }
    svg.text({120.0, 192.0},
             "50 to 500 Hz by 50, 0.6 to 3 V by 0.6, 0.4 s, ten times; gamma = 1 - A / A of the reference",
             {11.0});
    return svg.finish("A module on a layer on a phone, an accelerometer beside it", false);
}

void tellTransfer(ThesisPage& out) {
    out.page.heading("Information transfer as printed (Fig. 3.11, 4.2)");
    out.page.paragraph(
        "The most that so many stimuli can transfer is log2 of their number. The least is Fano's inequality "
        "for the printed percent correct: an IT below it cannot have that percent correct.");
    ExportTable table{
        "thesis-transfer", false,
        "study,condition,criterion,stimuli,it_bits,most_bits,percent_correct,least_bits,two_to_it,possible"};
    BarChart chart{{"transfer", "Information transfer of phantoms on grids, as printed", false},
                   "condition",
                   "IT (bit)",
                   {},
                   {{"exact, printed", {}},
                    {"least, by Fano", {}},
                    {"tolerance 1, printed", {}},
                    {"least, by Fano (tolerance)", {}}}};
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
            if (one.study != "phantom-grids") return;
            chart.series[2 * criterion].bars.emplace_back(ChartValue::around(bits));
            chart.series[2 * criterion + 1].bars.emplace_back(ChartValue::around(least));
        };
        add(0, one.bits, one.percentCorrect);
        add(1, one.bitsTolerance, one.percentTolerance);
        if (one.study != "phantom-grids") continue;
        chart.groups.emplace_back(one.condition);
        chart.ceilings.push_back(most);
    }
    chart.ceilingWords = "most possible";
    out.addFigure("transfer", {barChart(chart)},
                  "Printed IT beside the bounds of the printed percent correct. RING-5x5 with tolerance is "
                  "printed as 2.62 bit: impossible with 83.5 % correct.");
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

void tellMasses(ThesisPage& out) {
    out.page.heading("Masses of Table 5.1");
    ExportTable table{"thesis-masses", false, "object,mass_printed_kg,mass_kg,difference_kg"};
    for (const thesis::Body& one : thesis::bodies) {
        const double area = one.height > 0.0 ? one.size * one.height : std::numbers::pi * one.size * one.size,
                     mass = area * one.density;
        table.row(one.name, one.mass, mass, mass - one.mass);
    }
    out.addTable("masses.csv", table.text());
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
    static const std::vector<ThesisRow> rows = [] {
        const EmbeddedFile& file = thesisFile("thesis.json");
        return readEmbedded({file},
                            [](std::string_view text, std::string_view name) {
                                return readJson(text, name, limits::maxProtocolFileBytes, readRows);
                            })
            .front();
    }();
    return rows;
}

std::string thesisRowsCsv() {
    ExportTable table{"thesis", false, "at,what,run,needs,differs"};
    for (const ThesisRow& row : thesisRows()) table.row(row.at, row.what, row.run, row.needs, row.differs);
    return table.text();
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
    out.addTable("thesis.csv", thesisRowsCsv());
    out.page.heading("Modules (3.1.1)");
    out.addFigure("fig3-1", {modulesDrawing()},
                  "Actuators and layers in the printed sizes; cases, pads and rings have none in print.");
    out.addFigure("fig3-2", {hardnessDrawing()}, "How the scales lie to each other is no conversion.");
    out.addFigure("fig3-3", {setupDrawing()},
                  "`physvib attenuation` takes such recordings and draws Fig. 3.4 and 3.5.");
    tellTransfer(out);
    tellCounts(out);
    tellTests(out);
    tellMasses(out);
    return out;
}

} // namespace physvib
