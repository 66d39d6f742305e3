// SPDX-License-Identifier: MIT
// Atomic file writing: a file is written beside its place, then renamed: it appears complete or not.
#pragma once
#include "Io/Disk/SystemFile.h"
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace physvib {

/// A file being written, which commit() puts in its place. Without commit() it is removed by the destructor
/// or by a signal that ends the program (see removeFilesOnSignal()), and an earlier file at the path stays as
/// it was. Its temporary file locks the path: one writer at a time, in all programs. Message thread only.
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

    /// Writes `bytes` at that byte position. False after an error.
    bool writeAt(std::int64_t position, std::string_view bytes);

    /// Makes `bytes` the whole content. Returns error(); after an error nothing is left behind.
    const std::string& write(std::string_view bytes);

    /// Puts the file in its place before it is complete, once: later writes go there, and remain even if the
    /// program ends or an error occurs. Returns error(). If other programs remove or replace the file,
    /// commit() fails; if they change its length, the next write fails.
    const std::string& publish();

    /// Renames the temporary file onto the path, once, and flushes file and folder to disk, so that the
    /// result survives a power failure. After an error nothing is left behind.
    [[nodiscard]] const std::string& commit();

    /// Path of the temporary file, until commit(). Do not open it: another program may have replaced it.
    const std::filesystem::path& temporaryPath() const noexcept { return temporaryPath_; }

private:
    std::string prepare(); // why it cannot be written, empty once the temporary file exists
    std::string createTemporary(const std::filesystem::path& sibling);
    void moveIntoPlace();
    void failIfChanged();
    void fail(std::string_view reason);
    void removeTemporary() noexcept;

    std::filesystem::path givenPath_;  // as the caller wrote it, for messages
    std::filesystem::path targetPath_; // with links followed
    std::filesystem::path temporaryPath_;
    SystemFile file_;
    RemoveOnSignal removeOnSignal_;
    std::unique_ptr<AtomicFile> lock_; // locks the path after publish()
    std::int64_t writtenBytes_ = 0;    // length written so far
    int folderError_ = 0;              // errno of flushing the folder; 0: flushed
    std::string error_;
};

/// Writes `bytes` to `path` atomically. Returns "", or one line naming path and reason. Message thread only.
[[nodiscard]] std::string writeFile(const std::filesystem::path& path, std::string_view bytes);

} // namespace physvib
