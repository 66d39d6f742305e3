// SPDX-License-Identifier: GPL-3.0-or-later
// Recovery copies of sessions after a crash. Each run holds a lock on its copy, which the system releases
// when the run ends in any way.
#pragma once
#include "Io/Disk/SystemFile.h"
#include "Live/Documents/SessionFile.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// The copies in one folder. A copy is removed only when its replacement is on disk or the user discards it.
/// Message thread only.
class RecoveryCopies {
public:
    explicit RecoveryCopies(const std::filesystem::path& folder);
    ~RecoveryCopies();

    /// Copies of ended runs, newest first; they may be unreadable.
    std::vector<std::filesystem::path> leftBehind() const;

    /// The session of a copy, or one line that names the copy and the error.
    static Result<SavedSession> read(const std::filesystem::path& copy);

    /// Writes this run's copy to disk, then removes those that it replaces. Empty, or why it cannot be
    /// written.
    std::string keep(std::string_view session);
    /// This run replaces that copy.
    void goOnFrom(const std::filesystem::path& copy) { before_.push_back(copy); }
    /// Removes this run's copy and those that it replaces, after the session was saved or discarded.
    void forget();

    /// Discards a copy on the user's request. Empty, or why it still exists.
    static std::string remove(const std::filesystem::path& copy);

private:
    void lock();

    std::filesystem::path folder_, own_;
    std::vector<std::filesystem::path> before_;
    SystemFile lock_;
};

} // namespace physvib
