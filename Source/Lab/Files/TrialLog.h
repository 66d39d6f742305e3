// SPDX-License-Identifier: MIT
// A participant's trials as CSV: a row per trial, written at once, so that a study that was cut off can go
// on.
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

/// First lines of a trial file: where it is from, and the columns. Any thread.
std::string trialHeader(const Protocol& protocol, const Participant& participant, std::string_view version);

/// The columns of a protocol's trial files as they are begun now. Any thread (allocates).
std::vector<std::string> trialColumnsOf(const Protocol& protocol);

/// A trial's row in these columns, with its line end. Any thread.
std::string trialRow(const Protocol& protocol, const Participant& participant, const TrialRecord& record,
                     std::span<const std::string> columns);
inline std::string trialRow(const Protocol& protocol, const Participant& participant,
                            const TrialRecord& record) {
    return trialRow(protocol, participant, record, trialColumnsOf(protocol));
}

/// What a trial file holds so far.
struct TrialLog {
    std::vector<TrialRecord> records;
    std::vector<std::string> columns; ///< of the file; those of a new one where it has not even a header
    std::size_t wholeBytes = 0; ///< up to the last whole row: what follows was cut off while it was written
};

/// The trials of a file of this protocol and participant, up to the last whole row; or, of the first thing
/// that is wrong, one line. Of a record's trial only condition, session, number, stimulus and level are
/// filled in: an experiment knows the rest. Any thread.
Result<TrialLog> readTrialLog(std::string_view text, std::string_view name, const Protocol& protocol,
                              const Participant& participant);

/// A trial file that grows. M only.
class TrialLogFile {
public:
    /// Opens the file, or makes it with its header. What was cut off at its end is dropped. It is locked: one
    /// program at a time writes it.
    TrialLogFile(std::filesystem::path path, const Protocol& protocol, Participant participant,
                 std::string_view version);

    /// Empty, or one line that says why the file cannot be used.
    const std::string& error() const noexcept { return error_; }

    /// The trials that were there when it was opened.
    const std::vector<TrialRecord>& records() const noexcept { return records_; }

    /// Adds a row. A person's is on the disk before this returns; a simulated observer's, who would answer
    /// the same again, after sync(). False after an error.
    bool append(const TrialRecord& record);

    /// All rows are on the disk. False after an error.
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
