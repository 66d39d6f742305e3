// SPDX-License-Identifier: MIT
// Files of one participant: trials as CSV, each row written at once so that an interrupted study can resume,
// and the times of starts, breaks and ends.
#pragma once
#include "Core/Limits.h"
#include "Io/Disk/SystemFile.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Io/Text/CsvTable.h"
#include "Io/Text/CsvText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Experiment.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Header of a trial file: a line of provenance, and the column names. Any thread.
std::string trialHeader(const Protocol& protocol, const Participant& participant, std::string_view version);

/// Columns of new trial files of a protocol. Any thread (allocates).
std::vector<std::string> makeTrialColumns(const Protocol& protocol);

/// A trial's row in these columns, with line end. Any thread.
std::string trialRow(const Protocol& protocol, const Participant& participant, const TrialRecord& record,
                     std::span<const std::string> columns);
inline std::string trialRow(const Protocol& protocol, const Participant& participant,
                            const TrialRecord& record) {
    return trialRow(protocol, participant, record, makeTrialColumns(protocol));
}

/// Contents of a trial file.
struct TrialLog {
    std::vector<TrialRecord> records;
    std::vector<std::string> columns; ///< of the file; those of a new file if it has no complete header
    std::size_t completeBytes = 0;    ///< size up to the last complete row; the rest was interrupted while
                                      ///< writing
};

/// The complete rows of this protocol's and participant's file, or one line on the first error. Of each trial
/// only condition, session, number, stimulus and level are set; Experiment supplies the rest. Any thread.
Result<TrialLog> readTrialLog(std::string_view text, std::string_view name, const Protocol& protocol,
                              const Participant& participant);

/// An open trial file to which rows are appended. Message thread only.
class TrialLogFile {
public:
    /// Opens the file, or creates it with its header. Removes an incomplete last row. Locks the file, so that
    /// only one program writes it.
    TrialLogFile(std::filesystem::path path, const Protocol& protocol, Participant participant,
                 std::string_view version);

    /// Empty, or one line why the file cannot be used.
    const std::string& error() const noexcept { return error_; }

    /// Trials in the file when it was opened.
    const std::vector<TrialRecord>& records() const noexcept { return records_; }

    /// Appends a row. A person's row is on disk before this returns. A simulated observer's row is on disk
    /// after sync(), since its answers can be reproduced. Returns false after an error.
    bool append(const TrialRecord& record);

    /// Forces all rows to disk. Returns false after an error.
    bool sync() {
        if (error_.empty() && !file_.sync()) failToWrite();
        if (const auto change = file_.externalChange(path_, file_.size()); error_.empty() && !change.empty())
            fail(change);
        return error_.empty();
    }

private:
    void open(std::string_view version);
    bool write(const std::string& text) {
        if (error_.empty() && !file_.append(text)) failToWrite();
        return error_.empty();
    }
    void fail(const std::string& reason) { error_ = path_.string() + ": " + reason; }
    void failToWrite() { fail("cannot be written: " + file_.reason()); }

    std::filesystem::path path_;
    const Protocol& protocol_;
    Participant participant_;
    std::vector<TrialRecord> records_;
    std::vector<std::string> columns_;
    SystemFile file_;
    std::string error_;
};
} // namespace physvib

// Column names of trial files in their order, and fixed words in their cells.

namespace physvib::trialColumns {
constexpr std::string_view observer = "observer", phase = "phase", task = "task", render = "render";
constexpr std::string_view training = "training", simulated = "simulated";

/// Columns of every trial file. The study's rating scales follow them.
inline constexpr std::array<std::string_view, 21> names{
    "participant", "observer", "condition", "session",       "phase",      "trial",    "task",
    "stimulus",    "parts",    "response",  "target_column", "target_row", "x",        "y",
    "choice",      "value",    "correct",   "replays",       "response_s", "level_db", "render"};

/// Only in protocols with a QUEST+ session, after the scales: the prior before the first trial.
constexpr std::string_view quest = "quest";

/// Only in protocols with mixed staircases: number of the staircase that the trial belongs to.
constexpr std::string_view staircase = "staircase";

/// Only in protocols that limit the time for an answer: 1 if it ran out without an answer; else 0.
constexpr std::string_view timedOut = "ran_out";

/// Only in other programs' tables: the group of a participant who is compared with those of others.
constexpr std::string_view group = "group";

/// Measured values of each trial. Files that older versions began without them stay without them.
constexpr std::string_view peakG = "peak_g", rmsG = "rms_g", exposure = "a8_m_per_s2";
inline constexpr std::array<std::string_view, 3> measured{peakG, rmsG, exposure};

/// Settings of the apparatus. Files that older versions began without them stay without them.
constexpr std::string_view limiterDb = "limiter_db", masterDb = "master_db", noiseDb = "noise_db",
                           device = "device", version = "version";
inline constexpr std::array<std::string_view, 5> apparatus{limiterDb, masterDb, noiseDb, device, version};
constexpr std::string_view noNoise = "off"; ///< cell of noise_db without noise

/// Delivery of the trial, in the last columns; older files have none. Column left: 1 if every part left the
/// device as planned, 0 if one did not, empty if it is unknown. Column again: number of repeated plays.
constexpr std::string_view delivered = "left", revoked = "again";
inline constexpr std::array<std::string_view, 2> delivery{delivered, revoked};

constexpr bool isIn(const auto& list, std::string_view name) {
    return std::ranges::find(list, name) != list.end();
}
constexpr bool isDelivery(std::string_view name) { return isIn(delivery, name); }
constexpr bool isMeasured(std::string_view name) { return isIn(measured, name); }
constexpr bool isApparatus(std::string_view name) { return isIn(apparatus, name); }
constexpr bool has(std::string_view name) {
    return name == quest || name == staircase || name == timedOut || name == group || name == "target_x" ||
           name == "target_y" || isMeasured(name) || isApparatus(name) || isDelivery(name) ||
           isIn(names, name);
}
} // namespace physvib::trialColumns

// First line of a trial file as keys and values.

namespace physvib {
/// Values by key: version, protocol, hash, seed, participant and others.
using TrialHead = std::map<std::string, std::string>;

/// Parses the first comment line that names this program; empty if there is none. Any thread.
TrialHead parseTrialHead(const std::vector<std::string>& comments);

// Finds rows of trials that were not delivered as planned; they are not analysed.

/// True if the column `left` is 0, or without it if a part has a peak of 0 though a device was open and its
/// call does not ask for silence. Any thread.
inline bool wasNotDelivered(const CsvTable& table, const CsvRow& row) {
    if (const auto& delivered = table.cell(row, trialColumns::delivered); !delivered.empty())
        return delivered == "0";
    const auto& device = table.cell(row, trialColumns::device);
    if (device.empty() || device.starts_with("None:")) return false;
    const auto requestsSilence = [](std::string_view call) {
        constexpr std::string_view option = "--level-db ";
        const auto at = call.find(option);
        if (at == std::string_view::npos) return false;
        std::string_view rest = call.substr(at + option.size());
        return parseNumber<double>(takeUntil(' ', rest)).value_or(0.0) <= -limits::maxLevelDb;
    };
    std::string_view peaks = table.cell(row, trialColumns::peakG),
                     calls = table.cell(row, trialColumns::render);
    while (!peaks.empty()) {
        const std::string_view peak = takeUntil('|', peaks), call = calls.substr(0, calls.find(" ; "));
        calls.remove_prefix(std::min(call.size() + 3, calls.size()));
        if (parseNumber<double>(peak) == 0.0 && !requestsSilence(call)) return true;
    }
    return false;
}

/// "3 trials ran out of time, without an answer". Any thread.
inline std::string timeOutNote(std::size_t trials) {
    return plural(trials, "trial") + " ran out of time, without an answer";
}

/// "3 trials did not leave as planned and are left out". Any thread.
inline std::string undeliveredNote(std::size_t trials) {
    return plural(trials, "trial") + " did not leave as planned (column left, or a peak of 0 g) and " +
           (trials == 1 ? "is" : "are") + " left out";
}

// Times of a participant's study: starts, breaks, resumes and ends. They stand in a file of their own, so
// that a trial file has the same bytes whenever it was answered.

namespace studyEvents {
constexpr std::string_view start = "start", resume = "resume", breakStart = "break", goOn = "go-on",
                           pause = "pause", leave = "leave", end = "end";
} // namespace studyEvents

/// One line of the file. The last three fields are empty except in start and resume.
struct StudyEvent {
    std::string timeUtc;                         ///< 2026-11-24T14:02:31Z
    std::string event;                           ///< one of studyEvents
    int trials = 0;                              ///< answered so far
    std::string language, outputs, noiseOutputs; ///< "ko", "1 2 3 4", "5 6"
    bool operator==(const StudyEvent&) const = default;
    bool isStartOrResume() const { return event == studyEvents::start || event == studyEvents::resume; }
};

/// Whether the participant is on a break or has paused. Closing the window does not end a break.
struct StudyBreakState {
    bool isOnBreak = false, isPaused = false;
    void apply(const StudyEvent& entry) noexcept;
};

/// Path of the file of times beside a trial file. Any thread (allocates).
std::filesystem::path timesPath(const std::filesystem::path& trialFile);

/// The current time (UTC) as in StudyEvent, to the second. Any thread (allocates).
std::string utcNow();

/// Seconds since 1970 (UTC) of a time as in StudyEvent; NaN for other text. Any thread.
double unixSeconds(std::string_view timeUtc) noexcept;

/// The events of the file, none if it does not exist; or an error line. Message thread only.
Result<std::vector<StudyEvent>> loadStudyTimes(const std::filesystem::path& path);

/// Replaces the file by these events. Returns an error, or empty. Message thread only.
std::string writeStudyTimes(const std::filesystem::path& path, const std::vector<StudyEvent>& entries);

} // namespace physvib
