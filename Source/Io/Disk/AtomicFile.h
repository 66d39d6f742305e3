// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: written beside its place, then renamed onto it.
#pragma once
#include "Io/Disk/SystemFile.h"
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace physvib {

/// A file being written. commit() puts it in place; without that the destructor, or the signal that ends the
/// program (see removeAllOnEnd()), removes it, and whatever stood at the path before is untouched. Its
/// temporary file is its path's lock as well: one path has one writer at a time, in all programs. M only.
class AtomicFile {
public:
    /// Makes the empty temporary file beside `path`; see error(). A link at `path` is followed within its
    /// folder and below. Refused: a link that leads elsewhere, a folder, a device, a pipe (a rename would
    /// replace it), a file that may not be written, and one that is being written already.
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Empty, or one line naming the path and why it cannot be written.
    const std::string& error() const noexcept { return error_; }

    /// Whether that is because somebody else is writing it: then its path is worth another try.
    bool isTaken() const noexcept { return isTaken_; }

    /// These bytes at that place of the file. False after an error.
    bool writeAt(std::int64_t position, std::string_view bytes);

    /// Makes `bytes` all of the file. Returns error(); after an error nothing is left behind.
    const std::string& write(std::string_view bytes);

    /// Puts what was written in its place already, once: what follows is written there, and stays, whatever
    /// ends the program, also after an error. Returns error().
    const std::string& show();

    /// Renames the temporary file onto the path, once; then both the file and its name are on the disk, so
    /// that what was whole stays whole when the machine loses its power. After an error nothing is left
    /// behind.
    [[nodiscard]] const std::string& commit();

    /// Beside the path, until then. It is never opened again: what has that name need not be ours.
    const std::filesystem::path& temporaryPath() const noexcept { return temporary_; }

private:
    std::string prepare(); // why it cannot be written, empty once the temporary file exists
    std::string make(const std::filesystem::path& sibling);
    void place();
    void fail(std::string_view reason);
    void removeTemporary() noexcept;

    std::filesystem::path named_;  // as the caller wrote it, for messages
    std::filesystem::path target_; // with links followed
    std::filesystem::path temporary_;
    SystemFile file_;
    RemovedOnEnd onEnd_;
    std::unique_ptr<AtomicFile> lock_; // of the path, once the file is there
    std::string error_;
    bool isTaken_ = false;
};

/// Writes all of `bytes` to `path`, or leaves what was there. Gives "", or one line naming path and reason.
/// M only.
[[nodiscard]] std::string writeFile(const std::filesystem::path& path, std::string_view bytes);

} // namespace physvib
