// SPDX-License-Identifier: MIT
// Runs the analyses and tests of a report and shows each as a repeatable call.
#include "Lab/Report/ReportBuilder.h"
#include "Io/Text/NameList.h"
#include "Lab/Report/ReportCells.h"
#include <algorithm>
#include <set>

namespace physvib {
namespace {

std::string quoted(const std::string& word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.,=/:+";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    return shellWord(word);
}

/// Shortens text that is longer than a page.
std::string shortened(const std::string& words, const std::string& table) {
    constexpr std::size_t mostLines = 48, keptLines = 24;
    const auto lines = static_cast<std::size_t>(std::ranges::count(words, '\n'));
    if (lines <= mostLines) return words;
    std::size_t end = 0;
    for (std::size_t i = 0; i < keptLines; ++i) end = words.find('\n', end) + 1;
    return words.substr(0, end) + "... and " + std::to_string(lines - keptLines) + " lines more: " + table +
           "\n";
}

/// From the columns of sphericity: what the lines of effects with several degrees of freedom have.
std::string sphericitySentence(const std::vector<TestLine>& lines) {
    const auto has = [&](auto isSo) { return std::ranges::any_of(lines, isSo); };
    if (!has([](const TestLine& line) { return line.sphericity.has_value(); })) return {};
    const bool isTested =
        has([](const TestLine& line) { return line.sphericity && line.sphericity->mauchlyW; });
    return std::string{" Where an effect has more than one degree of freedom, its line has "} +
           (isTested ? "Mauchly's test of sphericity, where there are participants enough, and " : "") +
           "Greenhouse and Geisser's correction.";
}

} // namespace

std::string fileWord(const std::string& words) {
    std::string out = words;
    std::ranges::replace_if(
        out,
        [](char c) {
            return !((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
                     c == '_' || c == '.');
        },
        '_');
    return out;
}

std::string ReportTest::call() const {
    std::string words = "physvib analyse " + analysis;
    const auto say = [&words](std::string_view option, const std::string& value) {
        words.append(option).append(quoted(value));
    };
    for (const std::string& file : options.files) say(" ", file);
    say(" --measure ", options.measure);
    if (!options.within.empty()) say(" --within ", joined(options.within, ","));
    for (const std::string& where : options.where) say(" --where ", where);
    if (options.pairTest == PairTest::ranks) words += " --test ranks";
    if (options.correction == Correction::bonferroni) words += " --correction bonferroni";
    return words;
}

ReportBuilder::ReportBuilder(const ReportTrials& of, std::string title)
    : trials{of}
    , page{std::move(title), of.isSimulated} {}

std::size_t ReportBuilder::people() const {
    const Cells cell{trials.all};
    std::set<std::string_view> codes;
    for (const CsvRow& row : trials.all.rows) codes.insert(cell(row, "participant"));
    return std::max<std::size_t>(1, codes.size());
}

AnalysisJob ReportBuilder::optionsFor(const std::string& table) const {
    AnalysisJob options;
    options.files = {table};
    options.made = &tables_;
    return options;
}

void ReportBuilder::warn(const std::vector<std::string>& warnings) {
    std::vector<std::string> fresh;
    for (const std::string& words : warnings)
        if (std::ranges::find(warned_, words) == warned_.end()) fresh.push_back(words);
    warned_.insert(warned_.end(), fresh.begin(), fresh.end());
    page.notes(fresh);
}

AnalysisReport ReportBuilder::analysis(const std::string& kind, const AnalysisJob& options,
                                       const std::string& name) {
    AnalysisReport report = analyse(kind, options);
    warn(report.warnings);
    if (!report.words.empty()) page.lines(shortened(report.words, name));
    if (!report.error.empty())
        page.note(report.error);
    else
        tables_[name] = report.table;
    return report;
}

void ReportBuilder::tellAssumptions(AnalysisJob options, const std::string& name,
                                    const std::vector<TestLine>& lines) {
    options.correction = Correction::holm;
    const ReportTest check{"shapiro", options, "assumptions-" + name, 0};
    const AnalysisReport report = analyse("shapiro", options);
    if (!report.error.empty()) return page.note("whether values are normal was not tested: " + report.error);
    const auto beyond = std::ranges::count_if(report.lines, [](const TestLine& line) {
        return line.pCorrected.value_or(line.p.value_or(1.0)) < 0.05;
    });
    tables_[check.table] = report.table;
    page.paragraph("Assumptions: by Shapiro and Wilk's test the participants' values are not normal in " +
                   std::to_string(beyond) + " of " + std::to_string(report.lines.size()) +
                   " cells (p < 0.05, corrected by Holm for the cells; " + check.table + ")." +
                   sphericitySentence(lines));
    page.call(check.call() + " --correction holm");
}

std::vector<TestLine> ReportBuilder::test(const std::string& kind, AnalysisJob options,
                                          const std::string& name, bool isLong) {
    ReportTest test{kind, std::move(options), name, 0};
    page.call(test.call());
    const AnalysisReport report = analyse(kind, test.options);
    warn(report.warnings);
    if (!report.error.empty()) {
        page.note("not tested: " + report.error);
        return {};
    }
    tables_[name] = report.table;
    if (kind == "anova") tellAssumptions(test.options, name, report.lines);
    if (isLong) {
        const auto count = std::ranges::count_if(report.lines, [](const TestLine& line) {
            return line.pCorrected.value_or(line.p.value_or(1.0)) < 0.05;
        });
        page.paragraph(std::to_string(report.lines.size()) + " comparisons, " + std::to_string(count) +
                       " of them below 0.05 after correction: " + name);
        page.table(report.table, name, 200, true);
    } else
        page.lines(report.words);
    test.lines = report.lines.size();
    tests_.push_back(std::move(test));
    return report.lines;
}

} // namespace physvib
