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
    /// `banner` is shown below the title if it is not empty.
    ReportPage(std::string title, bool isSimulated, std::string banner = {});

    void addHeading(std::string_view text) { addElement("h2", text); }
    void addSubheading(std::string_view text) { addElement("h3", text); }
    void addParagraph(std::string_view text) { addElement("p", text); }
    void addNotes(const std::vector<std::string>& lines); ///< shows all lines in one box
    /// Adds a warning, or a note on why something is missing.
    void addNote(std::string_view text) { addNotes({std::string(text)}); }
    void addPreformatted(std::string_view text); ///< preformatted text, as `analyse` prints it
    void addList(const std::vector<std::string>& items) {
        body_ += "<ul>\n";
        for (const std::string& item : items) addElement("li", item);
        body_ += "</ul>\n";
    }
    /// A table from CSV text with comments, of at most `maxRows` rows and the columns that have a value. A
    /// folded table opens on a click and is not printed.
    void addTable(std::string_view csv, std::string_view file, std::size_t maxRows = 60,
                  bool isFolded = false);
    /// Adds charts side by side with one caption.
    void addFigure(const std::vector<std::string>& svgs, std::string_view caption);

    std::string html() const;

private:
    void addElement(std::string_view tag, std::string_view text);
    std::string title_, banner_, body_;
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
    std::string midpointName{};      ///< name of the level at which a function reaches 0.5
    std::string functionsText{};     ///< the fitted functions: "logistic, guess rate ..."
    std::string slopeName{};         ///< meaning of the column jnd
    bool isSimulated() const noexcept { return trials.isSimulated; }

    /// Number of participants in the rows, by the column participant; 1 without it.
    std::size_t participantCount() const;

    /// Options for an analysis of all trials.
    AnalysisJob options() const {
        AnalysisJob job;
        job.files = {trialsTable}, job.memoryTables = &tables_, job.protocol = trials.protocol;
        return job;
    }

    /// Adds a table. Precondition: its name is unused.
    void addTable(const std::string& name, std::string csv) { tables_[name] = std::move(csv); }
    /// Adds a table, and shows it on the page.
    void show(const std::string& name, const ExportTable& table, std::size_t maxRows = 60,
              bool isFolded = false) {
        addTable(name, table.text());
        page.addTable(table.text(), name, maxRows, isFolded);
    }
    const std::string& tableText(const std::string& name) const { return tables_.at(name); }
    /// Applies a reader of StudyCsv.h to the table of all trials.
    auto read(auto reader, const auto&... arguments) const {
        const NamedText file{tableText(trialsTable), trialsTable};
        return reader(std::span{&file, 1}, arguments...);
    }

    /// Runs an analysis: its summary and warnings go to the page, its table to the file `name`. `error` is
    /// empty on success.
    AnalysisReport addAnalysis(const std::string& kind, const AnalysisJob& options, const std::string& name);

    /// A reader's message on the table of all trials, with the trial's participant, condition and stimulus in
    /// place of file and line.
    std::string userMessage(const std::string& text) const;
    void noteFailedAnalysis(const std::string& error) { page.addNote("not analysed: " + userMessage(error)); }

    /// Frame of the next chart, with a unique name.
    ChartFrame nextFrame(std::string title) {
        return {"chart" + std::to_string(++charts_), std::move(title), isSimulated()};
    }

    const std::map<std::string, std::string>& tables() const noexcept { return tables_; }

private:
    void addWarnings(const std::vector<std::string>& warnings);
    std::map<std::string, std::string> tables_; // by file name
    std::vector<std::string> shownWarnings_;
    int charts_ = 0;
};

/// Numbers of participants for a caption: ", n = 12" or ", n = 9 to 12". Any thread (allocates).
inline std::string participantCountText(const std::vector<std::size_t>& counts) {
    const auto [minCount, maxCount] = std::ranges::minmax_element(counts);
    if (counts.empty()) return {};
    return ", n = " + std::to_string(*minCount) +
           (*minCount < *maxCount ? " to " + std::to_string(*maxCount) : "");
}

/// The end of a caption; explains the lines of intervals if there are any.
inline const char* intervalCaption(bool hasIntervals) {
    return hasIntervals ? ". Lines: 95 % intervals (t) of the table." : ".";
}

/// participantCountText() of the people who have trials in each condition.
template <class Condition>
std::string participantCountsText(const std::vector<Condition>& conditions) {
    std::vector<std::size_t> counts;
    for (const Condition& one : conditions) counts.push_back(groupByParticipant(one.trials).size());
    return participantCountText(counts);
}

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

void addParticipantsSection(ReportBuilder& report); ///< numbers of trials, exclusions, ethics and consent
void addProcedureSection(ReportBuilder& report);    ///< the protocol's fields, calls of the stimuli, levels,
                                                    ///< exposure
void addApparatusSection(ReportBuilder& report);    ///< device, levels, noise and limiter as recorded in the
                                                    ///< rows
void addTimesSection(ReportBuilder& report);    ///< dates, breaks, resumes and outputs, if files of times are
                                                ///< there
void addOrdersSection(ReportBuilder& report);   ///< condition orders as run
void addExposureSection(ReportBuilder& report); ///< levels and exposure, by condition and by stimulus
void addProvenanceSection(ReportBuilder& report); ///< versions, seeds, files

// Results; each section is for trials of one kind of task.
void addIdentificationSection(ReportBuilder& report); ///< percent correct, information transfer, confusions
void addPlacesSection(ReportBuilder& report); ///< targets on a grid: responses, territories, percent counts
void addPlaceErrorsSection(ReportBuilder& report); ///< targets without a grid: constant and variable error
void addChoicesSection(ReportBuilder& report);     ///< shares of alternatives
void addRatingsSection(ReportBuilder& report);     ///< scores of scales
void addLevelsSection(ReportBuilder& report); ///< staircases, adjustments, magnitudes; psychometric functions
/// Adds a chart of each condition's answers, and the fitted functions as the table `name`.
void addPsychometricFunctions(ReportBuilder& report, const StudyData<LevelAnswer>& data, AnalysisJob fit,
                              const std::string& name);
/// Counts answers in words by stimulus; true if there are any.
bool addDescriptionsSection(ReportBuilder& report);

// A protocol's fields and their values, for the section on methods, and for plans. Any thread (allocates).

// "layout phone1; stimuli grid; columns 3": each field with information, by its name in files.
std::string protocolText(const Protocol& protocol); ///< text on all but conditions and sessions
std::string conditionText(const ConditionPlan& condition);
std::string sessionText(const SessionPlan& session);

/// Range of the scale's scores, and the scale's definition.
std::string scoreText(const SessionPlan& session, const std::string& scale);

/// The full scale of each condition's layout, and whether it is calibrated: "phone1: 1 g, assumed".
std::string fullScales(const Protocol& protocol);

} // namespace physvib
