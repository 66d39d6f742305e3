// SPDX-License-Identifier: MIT
// A file that grows by whole lines while something plays, whatever the disk does meanwhile.
#pragma once
#include "Io/Disk/SystemFile.h"
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// What cannot be written waits, so that the file never ends inside a line; the next call tries again. One
/// thread at a time.
class GrowingFile {
public:
    /// Goes on at the end of the file, and nobody else does meanwhile.
    void open(const std::filesystem::path& path);

    /// Adds whole lines, behind what waits.
    void append(std::string_view lines);

    /// What was written is on the disk, or error() says why not.
    void sync() {
        if (error_.empty() && !file_.sync()) fail(file_.reason());
    }

    /// Empty, or one line: why something waits, or that more than maxWaitingBytes would have to; then it
    /// grows no more.
    const std::string& error() const noexcept { return error_; }

    static constexpr std::size_t maxWaitingBytes = 32'000'000; // twenty minutes of a lively session

private:
    void fail(const std::string& reason) { error_ = path_.string() + ": cannot be written: " + reason; }

    std::filesystem::path path_;
    SystemFile file_;
    std::string waiting_, error_;
    bool isOver_ = false;
};

} // namespace physvib
