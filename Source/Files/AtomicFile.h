// SPDX-License-Identifier: MIT
// A file that appears whole or not at all: written beside its place, then renamed onto it.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace physvib {

/// A file being written. Any writer may fill temporaryPath(); commit() puts it in place; without that the
/// destructor removes it, and whatever stood at the path before is untouched. M only.
class AtomicFile {
public:
    /// Creates the empty temporary file beside `path`; see error(). A link at `path` is followed. Refused: a
    /// folder, a device, a pipe (a rename would replace it) and a file that may not be written.
    explicit AtomicFile(const std::filesystem::path& path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Where to write; the file exists and is empty. Meaningless if there is an error().
    const std::filesystem::path& temporaryPath() const noexcept { return temporary_; }

    /// Empty, or one line naming the path and why it cannot be written.
    const std::string& error() const noexcept { return error_; }

    /// Makes `bytes` all of the temporary file. Returns error(); after an error nothing is left behind.
    const std::string& write(std::string_view bytes);

    /// Renames the temporary file onto the path, once. The writer has closed it, and asked its stream whether
    /// all of it was written: a full disk shows there. After an error nothing is left behind.
    [[nodiscard]] const std::string& commit();

private:
    std::string prepare(); // why it cannot be written, empty once the temporary file exists
    void fail(std::string_view reason);
    void removeTemporary() noexcept;

    std::filesystem::path named_;  // as the caller wrote it, for messages
    std::filesystem::path target_; // with links followed
    std::filesystem::path temporary_;
    std::string error_;
};

/// Writes all of `bytes` to `path`, or leaves what was there. Gives "", or one line naming path and reason.
/// M only.
[[nodiscard]] std::string writeFile(const std::filesystem::path& path, std::string_view bytes);

} // namespace physvib
