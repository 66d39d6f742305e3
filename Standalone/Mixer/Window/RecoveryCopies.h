// SPDX-License-Identifier: GPL-3.0-or-later
// Copies of sessions, in case a mixer ends badly: each under a lock that its run holds until it ends, however
// it does.
#pragma once
#include "Io/Disk/SystemFile.h"
#include "Live/Documents/SessionFile.h"
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

/// Those of one folder. A copy goes only when what takes its place is on the disk, or a person does without
/// it. M only.
class RecoveryCopies {
public:
    explicit RecoveryCopies(const std::filesystem::path& folder);
    ~RecoveryCopies();

    /// Those of runs that have ended, whole or not; the newest first.
    std::vector<std::filesystem::path> leftBehind() const;

    /// The session of a copy, or one line that names it and says why there is none.
    static Result<SavedSession> read(const std::filesystem::path& copy);

    /// Puts this run's copy on the disk; then those that it goes on from are removed. Empty, or why it cannot
    /// be written.
    std::string keep(std::string_view session);
    /// This run goes on from that copy.
    void goOnFrom(const std::filesystem::path& copy) { before_.push_back(copy); }
    /// This run's copy and those that it goes on from are not needed: they were saved, or a person does
    /// without them.
    void forget();

    /// A person does without it. Empty, or why it is still there.
    static std::string remove(const std::filesystem::path& copy);

private:
    void lock();

    std::filesystem::path folder_, own_;
    std::vector<std::filesystem::path> before_;
    SystemFile lock_;
};

} // namespace physvib
