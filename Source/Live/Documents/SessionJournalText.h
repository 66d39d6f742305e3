// SPDX-License-Identifier: MIT
// A session while it is played: lines that are only ever added, so that saving costs what is new.
//
// The first line is the head of a session file; each of the others adds one thing: a take, an input, a stall
// (which takes the place of the one before if it begins where that began), a control, recordings, a clip, a
// strike; or it says up to which time all of them have been told. What follows the last such line counts for
// nothing: it was cut off.
#pragma once
#include "Live/Documents/SessionFile.h"
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// Whether a session file is a journal. Any thread.
bool isJournal(std::string_view text) noexcept;

/// The session up to the last time that is told; or, of the first thing that is wrong, one line. Any thread.
Result<SavedSession> readJournal(std::string_view text, std::string_view name);

/// Makes the lines of one journal. One thread at a time.
class JournalLines {
public:
    /// Of `session` its head; paths of recordings become relative to `folder`.
    JournalLines(const SavedSession& session, std::filesystem::path folder);

    /// The first line.
    const std::string& head() const noexcept { return head_; }

    /// The lines of what Session::readLog has moved to `log` since the last call, which is all up to
    /// `sessionNs`; `log` keeps what the next call needs. Empty once the journal is full.
    std::string take(SessionLog& log, std::int64_t sessionNs);

    /// Empty, or what a file cannot hold more of: the session that was told ends there.
    const std::string& full() const noexcept { return full_; }
    std::int64_t toldNs() const noexcept { return toldNs_; }

private:
    std::string linesOf(SessionLog& log, std::int64_t sessionNs);

    int channels_;
    std::filesystem::path folder_;
    std::string head_, full_;
    std::size_t bytes_, inputs_ = 0; // inputs of the last take
    std::int64_t toldNs_ = 0;
    bool isBegun_ = false; // the first take of a log is one that was told
    WorldStall lastStall_{-1};
    SceneTake before_; // the take above the last, for its scene
};

} // namespace physvib
