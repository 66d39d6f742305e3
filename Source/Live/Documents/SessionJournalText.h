// SPDX-License-Identifier: MIT
// Session journal: a file written while a session is played. Lines are only appended, so saving costs as much
// as there is news.
//
// The first line is the head of a session file. Each further line adds one item: a scene run, an input, a
// stall, a control, recordings, a clip or a strike. A stall replaces the one before if it starts at the same
// time. A line with "seconds" says that all items up to that time are complete; lines after the last such
// line are ignored, because the file was cut off there.
#pragma once
#include "Live/Documents/SessionFile.h"
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// Whether the text of a session file is a journal. Any thread.
bool isJournal(std::string_view text) noexcept;

/// The session up to the last complete time; or one line about the first error. Any thread.
Result<SavedSession> readJournal(std::string_view text, std::string_view name);

/// Produces the lines of one journal. One thread at a time.
class JournalLines {
public:
    /// Writes the head from `session`; paths of recordings become relative to `folder`.
    JournalLines(const SavedSession& session, std::filesystem::path folder);

    /// The first line of the journal.
    const std::string& head() const noexcept { return head_; }

    /// Lines for the items that Session::readLog has moved to `log` since the last call; they are complete up
    /// to `sessionNs`. `log` keeps what the next call needs. Returns empty once the journal is full.
    std::string take(SessionLog& log, std::int64_t sessionNs);

    /// Empty, or the limit of the file that was reached; the journal ends there.
    const std::string& full() const noexcept { return full_; }
    std::int64_t toldNs() const noexcept { return toldNs_; }

private:
    std::string linesOf(SessionLog& log, std::int64_t sessionNs);

    int channels_;
    std::filesystem::path folder_;
    std::string head_, full_;
    std::size_t bytes_, inputs_ = 0; // inputs of the current scene run
    std::int64_t toldNs_ = 0;
    bool isBegun_ = false; // the first scene run of the log has been written
    WorldStall lastStall_{-1};
    SceneRun before_; // the scene run before the last, to compare scenes
};

} // namespace physvib
