// SPDX-License-Identifier: MIT
// A report as it grows: the page, the tables beside it, and the tests that both and the script in R repeat.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Report/ReportPage.h"
#include "Lab/Report/ReportTrials.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {

/// One call of `physvib analyse` in the report's folder.
struct ReportTest {
    std::string analysis; ///< "anova" ...
    AnalysisJob options;
    std::string table; ///< the file of its lines

    std::string call() const;
};

/// `words` as a part of a file's name: letters, digits, ., - and _ stay. Any thread.
std::string fileWord(const std::string& words);

/// The name of the table that has every trial.
inline constexpr const char* trialsTable = "trials.csv";

class ReportBuilder {
public:
    ReportBuilder(const ReportTrials& trials, std::string title);

    const ReportTrials& trials;
    ReportPage page;
    bool isSimulated() const noexcept { return trials.isSimulated; }

    /// Options of an analysis of these tables, which the report has made.
    AnalysisJob optionsFor(const std::string& table) const;

    /// Adds a table; its name is free.
    void addTable(const std::string& name, std::string csv) { tables_[name] = std::move(csv); }
    const std::string& tableText(const std::string& name) const { return tables_.at(name); }

    /// Runs an analysis: its warnings and words go onto the page, its table beside it, under `name`.CSV.
    /// Empty `error` if all is well.
    AnalysisReport analysis(const std::string& kind, const AnalysisJob& options, const std::string& name);

    /// Runs a test: its call and lines go onto the page, its table beside it. No lines: why not stands on the
    /// page. Long ones show no lines, only where they are.
    std::vector<TestLine> test(const std::string& kind, AnalysisJob options, const std::string& name,
                               bool isLong = false);

    /// Of the next chart, whose name no other has.
    ChartFrame frame(std::string title) {
        return {"chart" + std::to_string(++charts_), std::move(title), isSimulated()};
    }

    const std::vector<ReportTest>& tests() const noexcept { return tests_; }
    const std::map<std::string, std::string>& tables() const noexcept { return tables_; }

private:
    void warn(const std::vector<std::string>& warnings);
    void tellAssumptions(AnalysisJob options, const std::string& name); ///< of an analysis of variance
    std::map<std::string, std::string> tables_;                         // by file name
    std::vector<ReportTest> tests_;
    std::vector<std::string> warned_;
    int charts_ = 0;
};

} // namespace physvib
