// SPDX-License-Identifier: MIT
// Atomic file writing: a file appears complete or not at all. It is written beside its place, then renamed.
#pragma once
#include "Io/Disk/SystemFile.h"
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace physvib {

/// A file being written. commit() puts it in place. Without that the destructor, or the signal that ends the
/// program (see removeAllOnEnd()), removes it, and an earlier file at the path is unchanged. Its temporary
/// file also locks the path: one writer at a time, across all programs. Message thread (M) only.
class AtomicFile {
public:
    /// Creates the empty temporary file beside `path`; see error(). A link at `path` is followed if it leads
    /// into its folder or below. Refused: other links, a folder, a device or a pipe (a rename would replace
    /// it), a write-protected file, and one that is being written already.
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Empty, or one line naming the path and why it cannot be written.
    const std::string& error() const noexcept { return error_; }

    /// Writes `bytes` at that position. False after an error.
    bool writeAt(std::int64_t position, std::string_view bytes);

    /// Makes `bytes` the whole content. Returns error(); after an error nothing is left behind.
    const std::string& write(std::string_view bytes);

    /// Puts the file in its place early, once: later data is written there, and stays even if the program
    /// ends or an error occurs. Returns error(). Once others remove or replace it, commit() fails; once they
    /// change its length, the next write does.
    const std::string& show();

    /// Renames the temporary file onto the path, once, and flushes file and folder to disk, so that the
    /// result survives a power failure. After an error nothing is left behind.
    [[nodiscard]] const std::string& commit();

    /// Beside the path, until commit(). Do not open it again: another program may have replaced it.
    const std::filesystem::path& temporaryPath() const noexcept { return temporary_; }

private:
    std::string prepare(); // why it cannot be written, empty once the temporary file exists
    std::string make(const std::filesystem::path& sibling);
    void place();
    void failIfChanged();
    void fail(std::string_view reason);
    void removeTemporary() noexcept;

    std::filesystem::path named_;  // as the caller wrote it, for messages
    std::filesystem::path target_; // with links followed
    std::filesystem::path temporary_;
    SystemFile file_;
    RemovedOnEnd onEnd_;
    std::unique_ptr<AtomicFile> lock_; // locks the path after show()
    std::int64_t bytes_ = 0;           // written, up to the last
    int folderError_ = 0;              // why the folder was not flushed; 0: it was
    std::string error_;
};

/// Writes `bytes` to `path` atomically. Returns "", or one line naming path and reason. M only.
[[nodiscard]] std::string writeFile(const std::filesystem::path& path, std::string_view bytes);

} // namespace physvib
