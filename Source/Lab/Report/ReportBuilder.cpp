// SPDX-License-Identifier: MIT
// Writes the HTML of a report's page, and runs the analyses of its sections.
#include "Lab/Report/ReportBuilder.h"
#include "Io/Charts/ChartParts.h"
#include "Io/Text/CleanText.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include <iterator>
#include <set>
#include <utility>

namespace physvib {

// Writes the elements of a report's HTML page and its style sheet.

namespace {

constexpr std::string_view pageStyle = R"(
@page { size: A4; margin: 16mm 14mm; }
body { font: 15px/1.5 Georgia, "Times New Roman", serif; color: #1a1a1a; background: #fff; max-width: 720px; margin: 2em auto; padding: 0 1em; }
h1, h2, h3, th, td, figcaption, .note, .mark { font-family: Helvetica, Arial, sans-serif; }
h1 { font-size: 24px; line-height: 1.25; } h2 { font-size: 19px; margin-top: 2em; border-bottom: 1px solid #999; } h3 { font-size: 15.5px; margin-top: 1.6em; }
pre { font: 12px/1.45 "DejaVu Sans Mono", Menlo, Consolas, monospace; background: #f5f5f5; border-left: 3px solid #888; padding: .6em .8em; white-space: pre-wrap; overflow-wrap: anywhere; }
table { border-collapse: collapse; font-size: 11.5px; margin: .8em 0; max-width: 100%; } th, td { text-align: left; padding: 2px 6px; border-bottom: 1px solid #ddd; overflow-wrap: break-word; }
th { border-bottom: 1.5px solid #222; vertical-align: bottom; } td.number { text-align: right; font-variant-numeric: tabular-nums; overflow-wrap: normal; white-space: nowrap; }
figure { margin: 1.4em 0; text-align: center; break-inside: avoid; } figure svg { max-width: 100%; height: auto; } figcaption { font-size: 12.5px; text-align: left; color: #333; margin-top: .4em; }
.note { font-size: 13px; background: #fff6e0; border-left: 3px solid #E69F00; padding: .4em .8em; }
.mark { font-weight: bold; color: #b00020; border: 2px solid #b00020; padding: .4em .8em; }
.watermark { position: fixed; left: 0; right: 0; top: 45%; text-align: center; transform: rotate(-45deg); font: bold 88px Helvetica, Arial, sans-serif; color: #b00020; opacity: .07; pointer-events: none; }
@media print { body { margin: 0; padding: 0; max-width: none; font-size: 10.5pt; } h2, h3 { break-after: avoid; } tr { break-inside: avoid; } details { display: none; } a { color: inherit; text-decoration: none; }
  table { font-size: 6.6pt; } th, td { padding: 1px 2px; }
  * { -webkit-print-color-adjust: exact; print-color-adjust: exact; } }
)";

/// What a column of a table is called on a page; others are called as they are.
constexpr std::pair<std::string_view, std::string_view> headings[] = {
    {"participants_median_percent", "median (%)"},
    {"percent", "mean share (%)"},
    {"least_percent", "95 % interval, least (%)"},
    {"most_percent", "95 % interval, most (%)"},
    {"interval", "interval is"},
    {"estimate", "mean"},
    {"half_interval", "half of the 95 % interval (t)"},
    {"mean_percent", "mean of participants (%)"},
    {"percent_correct", "correct (%)"},
    {"chance_percent", "chance (%)"},
    {"it_bits", "IT (bit)"},
    {"corrected_it_bits", "IT less Miller's bias (bit)"},
    {"most_bits", "log2 of stimuli (bit)"},
    {"fano_bits", "Fano's lower bound (bit)"},
    {"mean_own_bits", "mean of participants' own IT, not corrected (bit)"},
    {"deviation_own_bits", "its SD (bit)"},
    {"standard_deviation", "SD"},
    {"df1", "df"},
    {"df2", "df of the error"},
    {"p_corrected", "corrected p"},
    {"p_across", "p corrected across"},
    {"across", "correction across"},
    {"effect_size", "effect size"},
    {"size", "effect size is"},
    {"interval_least", "95 % interval (t), least"},
    {"interval_most", "95 % interval (t), most"}};

/// Lets column names break after underscores.
std::string headHtml(const std::string& column) {
    const auto* const heading = std::ranges::find(headings, std::string_view{column},
                                                  &std::pair<std::string_view, std::string_view>::first);
    std::string out = "<th>";
    for (const char c : escapeXml(heading != std::end(headings) ? heading->second : column)) {
        out += c;
        if (c == '_') out += "<wbr>";
    }
    return out.append("</th>");
}

std::string cellHtml(const std::string& cell) {
    const bool isNumber = parseNumber<double>(cell).has_value();
    return (isNumber ? "<td class=\"number\">" : "<td>") + escapeXml(displayCell(cell)) + "</td>";
}

} // namespace

ReportPage::ReportPage(std::string title, bool isSimulated, std::string banner)
    : title_{std::move(title)}
    , banner_{std::move(banner)}
    , isSimulated_{isSimulated} {
    if (isSimulated_ && banner_.empty()) banner_ = "SIMULATED: a simulated observer answered, not a person.";
}

void ReportPage::addElement(std::string_view tag, std::string_view text) {
    const std::string_view name = tag.substr(0, tag.find(' '));
    body_.append("<").append(tag).append(">").append(escapeXml(text)).append("</").append(name).append(">\n");
}

void ReportPage::addNotes(const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    body_ += "<p class=\"note\">";
    for (const std::string& line : lines)
        body_ += (&line == &lines.front() ? "" : "<br>\n") + escapeXml(line);
    body_ += "</p>\n";
}
void ReportPage::addPreformatted(std::string_view text) {
    body_ += "<pre>";
    while (!text.empty()) body_ += escapeXml(takeUntil('\n', text)) + "\n";
    body_ += "</pre>\n";
}

void ReportPage::addTable(std::string_view csv, std::string_view file, std::size_t maxRows, bool isFolded) {
    const auto comments = csv.starts_with('#') ? 1 : 0;
    if (std::ranges::count(csv, '\n') < comments + 2) return addParagraph("none");
    const auto read = readCsvTable(csv, file);
    if (!read) return addNote(read.error);
    const auto& [name, lines, columns, rows] = read.value;
    const auto isEmpty = [&](std::size_t c) {
        return std::ranges::all_of(rows, [c](const CsvRow& row) { return row.cells[c].empty(); });
    };
    if (isFolded) body_ += "<details><summary>" + escapeXml(file) + "</summary>\n";
    body_ += "<table>\n<tr>";
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (!isEmpty(c)) body_ += headHtml(columns[c]);
    body_ += "</tr>\n";
    for (std::size_t r = 0; r < std::min(maxRows, rows.size()); ++r) {
        body_ += "<tr>";
        for (std::size_t c = 0; c < columns.size(); ++c)
            if (!isEmpty(c)) body_ += cellHtml(rows[r].cells[c]);
        body_ += "</tr>\n";
    }
    body_ += "</table>\n";
    if (rows.size() > maxRows)
        addParagraph(std::to_string(maxRows) + " of " + std::to_string(rows.size()) +
                     " rows: " + std::string(file));
    if (isFolded) body_ += "</details>\n";
}

void ReportPage::addFigure(const std::vector<std::string>& svgs, std::string_view caption) {
    body_ += "<figure>\n";
    for (const std::string& svg : svgs) body_ += svg;
    body_ += "<figcaption><b>Figure " + std::to_string(++figures_) + "</b> " + escapeXml(caption) +
             "</figcaption>\n</figure>\n";
}

std::string ReportPage::html() const {
    std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta "
                      "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    out += "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
           "'unsafe-inline'\">\n<title>" +
           escapeXml(title_) + (isSimulated_ ? " (simulated)" : "") + "</title>\n<style>" +
           std::string(pageStyle) + "</style>\n</head>\n<body>\n<h1>" + escapeXml(title_) + "</h1>\n";
    if (isSimulated_) out += "<div class=\"watermark\" aria-hidden=\"true\">SIMULATED</div>\n";
    if (!banner_.empty()) out += "<p class=\"mark\">" + escapeXml(banner_) + "</p>\n";
    return out + body_ + "</body>\n</html>\n";
}

ReportBuilder::ReportBuilder(const ReportTrials& source, std::string title)
    : trials{source}
    , page{std::move(title), source.isSimulated} {}

std::size_t ReportBuilder::participantCount() const {
    const Cells cell{trials.all};
    std::set<std::string_view> codes;
    for (const CsvRow& row : trials.all.rows) codes.insert(cell(row, "participant"));
    return std::max<std::size_t>(1, codes.size());
}

std::string ReportBuilder::userMessage(const std::string& text) const {
    std::string_view rest = text;
    if (!rest.starts_with(std::string{trialsTable} + ":")) return text;
    rest.remove_prefix(std::string_view{trialsTable}.size() + 1);
    if (rest.starts_with(' ')) return std::string{rest.substr(1)};
    const auto line = parseNumber<std::size_t>(takeUntil(':', rest));
    const auto table = readCsvTable(tableText(trialsTable), trialsTable);
    const Cells cell{table.value};
    for (const CsvRow& row : table.value.rows)
        if (row.line == line) {
            std::string trialText;
            for (const char* column : {"participant", "condition", "session", "stimulus"})
                if (!cell(row, column).empty())
                    trialText += (trialText.empty() ? "" : ", ") + std::string{column} + " " +
                                 cleanLine(cell(row, column));
            return trialText + ":" + std::string{rest};
        }
    return text;
}

void ReportBuilder::addWarnings(const std::vector<std::string>& warnings) {
    std::vector<std::string> newWarnings;
    const std::string excludedPrefix = std::string{trialsTable} + ": left out: "; // left-out.csv has them
    for (const std::string& text : warnings)
        if (!text.starts_with(excludedPrefix) &&
            std::ranges::find(shownWarnings_, text) == shownWarnings_.end())
            newWarnings.push_back(userMessage(text));
    shownWarnings_.insert(shownWarnings_.end(), warnings.begin(), warnings.end());
    page.addNotes(newWarnings);
}

AnalysisReport ReportBuilder::addAnalysis(const std::string& kind, const AnalysisJob& options,
                                          const std::string& name) {
    AnalysisReport report = analyse(kind, options);
    addWarnings(report.warnings);
    if (!report.error.empty()) {
        noteFailedAnalysis(report.error);
        return report;
    }
    page.addTable(report.summary, name);
    tables_[name] = report.table;
    return report;
}

} // namespace physvib
