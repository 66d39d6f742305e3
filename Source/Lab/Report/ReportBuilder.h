// SPDX-License-Identifier: MIT
// A report under construction: its page and its tables; and the sections that write into it.
#pragma once
#include "Io/Charts/Charts.h"
#include "Io/Text/CsvTable.h"
#include "Lab/Analysis/Analysis.h"
#include "Lab/Analysis/StudyCharts.h"
#include "Lab/Report/ReportTrials.h"
#include "Lab/Study/Protocol.h"
#include "Lab/Study/Summaries.h"
#include <algorithm>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

// An HTML page without network access or scripts, for screen and A4. Text from files is escaped here.

class ReportPage {
public:
    /// `mark` is shown below the title if it is not empty.
    ReportPage(std::string title, bool isSimulated, std::string mark = {});

    void heading(std::string_view words) { element("h2", words); }
    void subheading(std::string_view words) { element("h3", words); }
    void paragraph(std::string_view words) { element("p", words); }
    void notes(const std::vector<std::string>& lines); ///< in one box
    /// A warning, or why something is missing.
    void note(std::string_view words) { notes({std::string(words)}); }
    void lines(std::string_view words); ///< preformatted text, as `analyse` prints it
    void list(const std::vector<std::string>& items) {
        body_ += "<ul>\n";
        for (const std::string& item : items) element("li", item);
        body_ += "</ul>\n";
    }
    /// A table from CSV text with comments, of at most `mostRows` rows and the columns that have a value. A
    /// folded table opens on a click and is not printed.
    void table(std::string_view csv, std::string_view file, std::size_t mostRows = 60, bool isFolded = false);
    /// Charts side by side with one caption.
    void figure(const std::vector<std::string>& svgs, std::string_view caption);

    /// The complete file.
    std::string html() const;

private:
    void element(std::string_view tag, std::string_view words);
    std::string title_, mark_, body_;
    bool isSimulated_;
    int figures_ = 0;
};

/// Name of the table of all trials.
inline constexpr const char* trialsTable = "trials.csv";

class ReportBuilder {
public:
    ReportBuilder(const ReportTrials& trials, std::string title);

    const ReportTrials& trials;
    ReportPage page;
    std::vector<std::string> scales; ///< columns of ratings that can be read
    std::string half{};              ///< what the page calls the level of a half
    std::string functions{};         ///< "logistic, guess rate ...", of those that are fitted
    std::string slope{};             ///< what the column jnd is
    bool isSimulated() const noexcept { return trials.isSimulated; }

    /// Number of participants in the rows, by the column participant; 1 without it.
    std::size_t people() const;

    /// Options for an analysis of all trials.
    AnalysisJob options() const {
        AnalysisJob job;
        job.files = {trialsTable}, job.made = &tables_, job.protocol = trials.protocol;
        return job;
    }

    /// Adds a table. Precondition: its name is unused.
    void addTable(const std::string& name, std::string csv) { tables_[name] = std::move(csv); }
    /// Adds a table, and shows it on the page.
    void show(const std::string& name, const ExportTable& table, std::size_t mostRows = 60,
              bool isFolded = false) {
        addTable(name, table.text());
        page.table(table.text(), name, mostRows, isFolded);
    }
    const std::string& tableText(const std::string& name) const { return tables_.at(name); }
    /// Applies a reader of StudyCsv.h to the table of all trials.
    auto read(auto reader, const auto&... how) const {
        const NamedText file{tableText(trialsTable), trialsTable};
        return reader(std::span{&file, 1}, how...);
    }

    /// Runs an analysis: what it shows and what it left out go to the page, its table to `name`. `error` is
    /// empty on success.
    AnalysisReport analysis(const std::string& kind, const AnalysisJob& options, const std::string& name);

    /// A reader's message on the table of all trials, with the trial's participant, condition and stimulus in
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

/// ", n = 12", or ", n = 9 to 12", of what a figure shows.
inline std::string ofPeople(const std::vector<std::size_t>& counts) {
    const auto [fewest, most] = std::ranges::minmax_element(counts);
    if (counts.empty()) return {};
    return ", n = " + std::to_string(*fewest) + (*fewest < *most ? " to " + std::to_string(*most) : "");
}

/// The end of a caption: what the lines are, if there are any.
inline const char* lastOfCaption(bool hasIntervals) {
    return hasIntervals ? ". Lines: 95 % intervals (t) of the table." : ".";
}

/// How many people gave the trials of each condition.
template <class Condition>
std::string ofPeopleIn(const std::vector<Condition>& conditions) {
    std::vector<std::size_t> counts;
    for (const Condition& one : conditions) counts.push_back(byParticipant(one.trials).size());
    return ofPeople(counts);
}

// Cells of a report's rows by the names of their columns.

/// Cells of a row by column name; an empty string for missing columns.
class Cells {
public:
    explicit Cells(const CsvTable& table)
        : table_{table} {}
    const std::string& operator()(const CsvRow& row, std::string_view column) const {
        return table_.cell(row, column);
    }
    bool has(std::string_view column) const { return table_.column(column).has_value(); }

private:
    const CsvTable& table_;
};

// The sections of a report, in order.

void tellParticipants(ReportBuilder& report); ///< numbers of trials, exclusions, ethics and consent
void tellProcedure(ReportBuilder& report); ///< the protocol's fields, calls of the stimuli, levels, exposure
void tellApparatus(ReportBuilder& report); ///< device, levels, noise and limiter as recorded in the rows
void tellTimes(ReportBuilder& report);  ///< dates, breaks, resumes and outputs, if files of times are there
void tellOrders(ReportBuilder& report); ///< condition orders as run
void tellDoses(ReportBuilder& report);  ///< levels and exposure, by condition and by stimulus
void tellProvenance(ReportBuilder& report); ///< versions, seeds, files

// Results; each section is for trials of one kind of task.
void tellIdentification(ReportBuilder& report); ///< percent correct, information transfer, confusions
void tellPlaces(ReportBuilder& report);         ///< targets on a grid: responses, territories, percent counts
void tellPlaceErrors(ReportBuilder& report);    ///< targets without a grid: constant and variable error
void tellChoices(ReportBuilder& report);        ///< shares of alternatives
void tellRatings(ReportBuilder& report);        ///< scores of scales
void tellLevels(ReportBuilder& report); ///< staircases, adjustments, magnitudes; psychometric functions
/// A chart of each condition's answers, and functions if somebody has one, in the table `name`.
void tellFunctions(ReportBuilder& report, const StudyData<LevelAnswer>& data, AnalysisJob fit,
                   const std::string& name);
/// Counts answers in words by stimulus; true if there are any.
bool tellDescriptions(ReportBuilder& report);

// A protocol's fields and their values, for the section on methods, and for plans. Any thread (allocates).

// "layout phone1; stimuli grid; columns 3": each field that says something, by its name in files.
std::string protocolWords(const Protocol& protocol); ///< without conditions and sessions
std::string conditionWords(const ConditionPlan& condition);
std::string sessionWords(const SessionPlan& session);

/// Range of the scale's scores, and the scale's definition.
std::string scoreWords(const SessionPlan& session, const std::string& scale);

/// The full scale of each condition's layout, and whether it is calibrated: "phone1: 1 g, assumed".
std::string fullScales(const Protocol& protocol);

} // namespace physvib
