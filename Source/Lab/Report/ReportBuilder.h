// SPDX-License-Identifier: MIT
// A report under construction: its page and its tables; and the sections that write into it.
#pragma once
#include "Io/Charts/Charts.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Report/ReportPage.h"
#include "Lab/Report/ReportTrials.h"
#include "Lab/Study/ThesisDeviations.h"
#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {
/// Name of the table of all trials.
inline constexpr const char* trialsTable = "trials.csv";

class ReportBuilder {
public:
    ReportBuilder(const ReportTrials& trials, std::string title);

    const ReportTrials& trials;
    ReportPage page;
    std::vector<std::string> scales; ///< columns of ratings that can be read
    std::string half{};              ///< what the page calls the level of a half
    std::string functions{};         ///< "logistic, with ...", of those that are fitted
    bool isSimulated() const noexcept { return trials.isSimulated; }

    /// Number of participants in the rows, by the column participant; 1 without it.
    std::size_t people() const;

    /// ", 95 % intervals over participants", if there are several; of one, `overTrials` or none.
    std::string intervals(bool overTrials = false) const {
        return people() > 1 ? ", 95 % intervals over participants"
               : overTrials ? ", 95 % intervals over trials, of one participant"
                            : ", of one participant without intervals";
    }

    /// Of a version NAME-thesis.
    bool isAsPublished() const { return trials.protocol && trials.protocol->name.ends_with(thesisSuffix); }

    /// " (as thesis Fig. 4.4)" in the report of one of the thesis' own studies, else empty.
    std::string asThesis(std::string_view figure) const {
        std::string_view name = trials.protocol ? trials.protocol->name : std::string_view{};
        if (isAsPublished()) name.remove_suffix(thesisSuffix.size());
        return std::ranges::find(thesisDeviations, name, &ThesisDeviation::protocol) != thesisDeviations.end()
                   ? " (as thesis " + std::string{figure} + ")"
                   : std::string{};
    }

    /// Of an analysis of all trials.
    AnalysisJob options() const {
        AnalysisJob job;
        job.files = {trialsTable}, job.made = &tables_;
        return job;
    }

    /// Adds a table. Precondition: its name is unused.
    void addTable(const std::string& name, std::string csv) { tables_[name] = std::move(csv); }
    const std::string& tableText(const std::string& name) const { return tables_.at(name); }
    /// What a reader finds in the table of all trials.
    auto read(auto reader, const auto&... how) const {
        const NamedText file{tableText(trialsTable), trialsTable};
        return reader(std::span{&file, 1}, how...);
    }

    /// Runs an analysis: warnings and text go to the page, its table to `name`. `error` is empty on success.
    AnalysisReport analysis(const std::string& kind, const AnalysisJob& options, const std::string& name);

    /// What a reader says of the table of all trials, with the trial's participant, condition and stimulus in
    /// place of file and line.
    std::string said(const std::string& words) const;
    void tellFault(const std::string& error) { page.note("not analysed: " + said(error)); }

    /// Frame of the next chart, with a unique name.
    ChartFrame frame(std::string title) {
        return {"chart" + std::to_string(++charts_), std::move(title), isSimulated()};
    }

    const std::map<std::string, std::string>& tables() const noexcept { return tables_; }

private:
    void warn(const std::vector<std::string>& warnings);
    std::map<std::string, std::string> tables_; // by file name
    std::vector<std::string> warned_;
    int charts_ = 0;
};

// Cells of a report's rows by the names of their columns.

/// Cells of a row by column name; an empty string for missing columns.
class Cells {
public:
    explicit Cells(const CsvTable& table)
        : table_{table} {}
    const std::string& operator()(const CsvRow& row, std::string_view column) const {
        static const std::string none;
        const auto at = table_.column(column);
        return at ? row.cells[*at] : none;
    }
    bool has(std::string_view column) const { return table_.column(column).has_value(); }

private:
    const CsvTable& table_;
};

// The sections of a report, in order.

void tellParticipants(ReportBuilder& report); ///< numbers of trials, exclusions, ethics and consent
void tellProcedure(ReportBuilder& report); ///< protocol in sentences, calls of the stimuli, levels, exposure
void tellApparatus(ReportBuilder& report); ///< device, levels, noise and limiter as recorded in the rows
void tellTimes(ReportBuilder& report);  ///< dates, breaks, resumes and outputs, if files of times are there
void tellOrders(ReportBuilder& report); ///< condition orders as run
void tellDoses(ReportBuilder& report);  ///< levels and exposure, by condition and by stimulus
void tellProvenance(ReportBuilder& report); ///< versions, seeds, files

// Results; each section is for trials of one kind of task.
void tellIdentification(ReportBuilder& report); ///< thesis Fig. 3.11, 3.12, 4.2 to 4.4
void tellPlaces(ReportBuilder& report);         ///< Fig. 4.6 to 4.9, Table 4.1
void tellPlaceErrors(ReportBuilder& report);    ///< targets without a grid: constant and variable error
void tellChoices(ReportBuilder& report);        ///< Fig. 5.8, 5.9
void tellRatings(ReportBuilder& report);        ///< Fig. 5.13, 5.14
void tellLevels(ReportBuilder& report); ///< staircases, adjustments, magnitudes; psychometric functions
/// A chart of each condition's answers, and functions if somebody has one, in the table `name`.
void tellFunctions(ReportBuilder& report, const StudyData<LevelAnswer>& data, AnalysisJob fit,
                   const std::string& name);
/// Counts answers in words by stimulus; true if there are any.
bool tellDescriptions(ReportBuilder& report);

/// "P01 began at ...": from the columns time_utc, event, language, outputs and noise_outputs. Precondition:
/// there are moments. Any thread (allocates).
std::string timesSentence(const std::string& participant, const std::vector<StudyMoment>& moments);

} // namespace physvib
