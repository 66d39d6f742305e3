// SPDX-License-Identifier: MIT
// A log file that grows by whole lines while a session plays, and tolerates temporary disk errors.
#pragma once
#include "Io/Disk/SystemFile.h"
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// Lines that cannot be written stay pending, so that the file never ends inside a line; the next call
/// retries. One thread at a time.
class GrowingFile {
public:
    /// Continues at the end of the file, and locks it against other writers.
    void open(const std::filesystem::path& path);

    /// Adds whole lines, after the pending ones.
    void append(std::string_view lines);

    /// Flushes to disk; on failure error() has the reason. False if others have removed, replaced or cut the
    /// file.
    bool sync();

    /// Empty, or one line: why lines are pending, or that maxWaitingBytes were exceeded; after that the file
    /// grows no more.
    const std::string& error() const noexcept { return error_; }

    static constexpr std::size_t maxWaitingBytes = 32'000'000; // twenty minutes of a lively session

private:
    void fail(const std::string& reason) { error_ = path_.string() + ": cannot be written: " + reason; }

    std::filesystem::path path_;
    SystemFile file_;
    std::string waiting_, error_;
    std::int64_t bytes_ = 0; // of the file, as it was left
    bool isOver_ = false;
};

} // namespace physvib
