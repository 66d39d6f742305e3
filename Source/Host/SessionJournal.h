// SPDX-License-Identifier: GPL-3.0-or-later
// A live session on disk while it plays: what it takes to render it again, and what was played.
#pragma once
#include "Files/EventsCsv.h"
#include "Files/SessionFile.h"
#include "Host/Session.h"
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

namespace physvib {

/// Whatever ends the program, the files are whole up to the last keep(). M only.
class SessionJournal {
public:
    /// Saves `session`, which outlives this object, as `path` (.json), and the events played beside it as .events.csv.
    /// `setup` is what the session was made with, `provenance` stands in the list of events.
    SessionJournal(std::filesystem::path path, const Session& session, const SessionSetup& setup, const Provenance& provenance);

    /// Empty, or why one of the files cannot be written.
    const std::string& error() const noexcept { return error_; }

    /// An event that was played.
    void take(const PlayedEvent& played);

    /// Writes all until now, which is session time `sessionNs`.
    void keep(std::int64_t sessionNs);

    const std::filesystem::path& eventsPath() const noexcept { return eventsPath_; }

private:
    struct Close {
        void operator()(std::FILE* file) const noexcept { std::fclose(file); }
    };
    std::filesystem::path path_, eventsPath_;
    const Session& session_;
    SavedSession saved_;
    std::string rows_; // not written yet
    std::int64_t lastNs_ = 0;
    std::unique_ptr<std::FILE, Close> events_;
    std::string error_;
};

} // namespace physvib
