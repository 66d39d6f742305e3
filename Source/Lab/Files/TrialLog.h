// SPDX-License-Identifier: MIT
// CSV file of one participant's trials. Each row is written at once, so that an interrupted study can resume.
#pragma once
#include "Io/Disk/SystemFile.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Lab/Study/Trial.h"
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Header of a trial file: a line of provenance, and the column names. Any thread.
std::string trialHeader(const Protocol& protocol, const Participant& participant, std::string_view version);

/// Columns of new trial files of a protocol. Any thread (allocates).
std::vector<std::string> trialColumnsOf(const Protocol& protocol);

/// A trial's row in these columns, with line end. Any thread.
std::string trialRow(const Protocol& protocol, const Participant& participant, const TrialRecord& record,
                     std::span<const std::string> columns);
inline std::string trialRow(const Protocol& protocol, const Participant& participant,
                            const TrialRecord& record) {
    return trialRow(protocol, participant, record, trialColumnsOf(protocol));
}

/// Contents of a trial file.
struct TrialLog {
    std::vector<TrialRecord> records;
    std::vector<std::string> columns; ///< of the file; those of a new file if it has no complete header
    std::size_t wholeBytes = 0; ///< size up to the last complete row; the rest was interrupted while writing
};

/// Reads the complete rows of this protocol's and participant's file, or returns one line on the first error.
/// Of each trial only condition, session, number, stimulus and level are set; Experiment supplies the rest.
/// Any thread.
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
    bool sync();

private:
    void open(std::string_view version);
    bool write(const std::string& text);
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
