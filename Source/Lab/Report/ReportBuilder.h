// SPDX-License-Identifier: MIT
// A report under construction: its page, its tables, and the list of tests that analysis.R runs.
#pragma once
#include "Io/Charts/Charts.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Report/AnalysisScript.h"
#include "Lab/Report/ReportPage.h"
#include "Lab/Report/ReportTrials.h"
#include <map>
#include <string>
#include <vector>

namespace physvib {

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

    /// Adds a test to analysis.R, and to the page that it runs there. None of a single participant.
    void test(StudyTest test);

    /// Frame of the next chart, with a unique name.
    ChartFrame frame(std::string title) {
        return {"chart" + std::to_string(++charts_), std::move(title), isSimulated()};
    }

    const std::vector<StudyTest>& tests() const noexcept { return tests_; }
    const std::map<std::string, std::string>& tables() const noexcept { return tables_; }

private:
    void warn(const std::vector<std::string>& warnings);
    std::map<std::string, std::string> tables_; // by file name
    std::vector<StudyTest> tests_;
    std::vector<std::string> warned_;
    int charts_ = 0;
};

} // namespace physvib
