// SPDX-License-Identifier: MIT
// A report under construction: its page, its tables, and the list of tests that the R script repeats.
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
    std::string table;     ///< name of the file with its results
    std::size_t lines = 0; ///< comparisons or effects

    std::string call() const;
};

/// `words` as part of a file name: letters, digits, ., - and _ are kept. Any thread.
std::string fileWord(const std::string& words);

/// Name of the table of all trials.
inline constexpr const char* trialsTable = "trials.csv";

class ReportBuilder {
public:
    ReportBuilder(const ReportTrials& trials, std::string title);

    const ReportTrials& trials;
    ReportPage page;
    bool isSimulated() const noexcept { return trials.isSimulated; }

    /// Number of participants in the rows, by the column participant; 1 without it.
    std::size_t people() const;

    /// ", 95 % intervals over participants"; of one participant, who has none, that there are none.
    std::string intervals() const {
        return people() > 1 ? ", 95 % intervals over participants" : ", of one participant without intervals";
    }

    /// Options for an analysis of one of the report's tables.
    AnalysisJob optionsFor(const std::string& table) const;

    /// Adds a table. Precondition: its name is unused.
    void addTable(const std::string& name, std::string csv) { tables_[name] = std::move(csv); }
    const std::string& tableText(const std::string& name) const { return tables_.at(name); }

    /// Runs an analysis. Its warnings and text are added to the page, and its table is stored as `name`.CSV.
    /// `error` is empty on success.
    AnalysisReport analysis(const std::string& kind, const AnalysisJob& options, const std::string& name);

    /// Runs a test. Its call and results are added to the page, and its table is stored. If the test fails,
    /// the page has the reason and no lines are returned. With `isLong`, the page only names the table.
    std::vector<TestLine> test(const std::string& kind, AnalysisJob options, const std::string& name,
                               bool isLong = false);

    /// Frame of the next chart, with a unique name.
    ChartFrame frame(std::string title) {
        return {"chart" + std::to_string(++charts_), std::move(title), isSimulated()};
    }

    const std::vector<ReportTest>& tests() const noexcept { return tests_; }
    const std::map<std::string, std::string>& tables() const noexcept { return tables_; }

private:
    void warn(const std::vector<std::string>& warnings);
    /// Assumptions of an analysis of variance with these effects.
    void tellAssumptions(AnalysisJob options, const std::string& name, const std::vector<TestLine>& lines);
    std::map<std::string, std::string> tables_; // by file name
    std::vector<ReportTest> tests_;
    std::vector<std::string> warned_;
    int charts_ = 0;
};

} // namespace physvib
