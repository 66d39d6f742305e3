// SPDX-License-Identifier: MIT
// An open file with a lock, removal of temporary files when a signal ends the program, and opening of files
// and pipes, by system calls. SystemFilePosix.cpp and SystemFileWindows.cpp implement these.
#pragma once
#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// A regular file that stays open, so that a replacement at its path is detected. The first error is kept and
/// later operations fail. One thread at a time, not the render thread.
class SystemFile {
public:
    /// Creates a new file; an error if the name exists, even as a link.
    static SystemFile create(const std::filesystem::path& path);

    /// Opens an existing file for appending, or creates it. A link is followed unless it leads out of its
    /// folder; a pipe or a device is an error and does not block.
    static SystemFile openForAppending(const std::filesystem::path& path);

    /// Opens an existing file only to lock and identify it; links are refused.
    static SystemFile openForLocking(const std::filesystem::path& path);

    SystemFile() = default;
    SystemFile(SystemFile&& other) noexcept;
    SystemFile& operator=(SystemFile&& other) noexcept;
    ~SystemFile();

    bool isOpen() const noexcept { return handle_ != noHandle; }
    /// The first error as an errno value, on every system; 0: none. reason(): the same as text.
    int error() const noexcept { return error_; }
    std::string reason() const;
    /// Forgets the error, for a retry: a full disk may have space again.
    void clearError() noexcept { error_ = isOpen() ? 0 : error_; }

    enum class Lock { acquired, heldByOthers, unsupported }; ///< unsupported: the file system has no locks
    /// Tries to lock the file against other programs, until it is closed or the program ends; does not wait.
    Lock lock() noexcept;

    /// Writes all of `bytes` at that position; false on failure.
    bool writeAt(std::int64_t position, std::string_view bytes) noexcept;

    /// Appends all of `bytes`; on failure false, and the length is unchanged.
    bool append(std::string_view bytes) noexcept;

    /// Flushes to disk, so that the data survives a power failure; false on failure. Blocks.
    bool sync() noexcept;

    bool resize(std::int64_t bytes) noexcept; ///< cuts or extends with zeros; false on failure
    std::int64_t size() noexcept;             ///< in bytes; 0 after an error

    /// True if `path` itself, not a link there, is this file.
    bool isAt(const std::filesystem::path& path) const noexcept;

    /// Empty, or how another program changed this file: it was removed or replaced at `path` (links are
    /// followed), or its length is no longer `bytes`.
    std::string externalChange(const std::filesystem::path& path, std::int64_t bytes);

    /// Copies permissions from `path`. Best effort: another owner's permissions cannot always be copied, and
    /// on Windows a new file has its folder's.
    void copyPermissionsFrom(const std::filesystem::path& path) const noexcept;

    /// Flushes the names in a folder after a file was created or renamed. Returns 0, also on systems without
    /// that, or the error number if the disk failed.
    static int syncFolder(const std::filesystem::path& folder) noexcept;

private:
    friend class RemoveOnSignal;
    using Handle = std::intptr_t; // POSIX: a descriptor
    static constexpr Handle noHandle = -1;
    enum class Opening { create, append, lockOnly };
    static SystemFile openWith(const std::filesystem::path& path, Opening opening) noexcept;
    static bool isAt(Handle handle, const std::filesystem::path& path) noexcept;
    static void removePath(const std::filesystem::path& path) noexcept; // one system call, nothing else
    void closeHandle() noexcept;
    void closeAsIrregular() noexcept;     // refuses files that are not regular
    bool recordError(bool isOk) noexcept; // records the first system error

    Handle handle_ = noHandle;
    int error_ = 0;
};

/// While it exists, removes a file if a signal ends the program (see removeFilesOnSignal()). Not on the
/// render thread.
class RemoveOnSignal {
public:
    RemoveOnSignal() = default;
    /// `file` must outlive this object; it is removed only if `name` still refers to it.
    RemoveOnSignal(const SystemFile& file, const std::filesystem::path& name);
    RemoveOnSignal& operator=(RemoveOnSignal&& other) noexcept;
    ~RemoveOnSignal();

private:
    friend void removeFilesOnSignal() noexcept;
    struct Removal;
    static void removeAll() noexcept;
    static std::array<std::atomic<Removal*>, 256> removals; // whoever takes an entry out of its slot owns it;
                                                            // signal handlers never free it
    int slot_ = -1;
};

/// While it exists, signals that end the program are deferred for its thread (on Windows: console events, for
/// the process). Covers the time between creating a file and registering its removal. Not on the render
/// thread.
class DeferredSignals {
public:
    DeferredSignals() noexcept;
    ~DeferredSignals();
    DeferredSignals(const DeferredSignals&) = delete;
    DeferredSignals& operator=(const DeferredSignals&) = delete;

private:
    unsigned blockedBefore_ = 0; // signals that were blocked already
};

/// Removes all registered files. For signal handlers; only on Windows it waits, for DeferredSignals.
void removeFilesOnSignal() noexcept;

/// The signals that end a program unless it handles them: Ctrl-C, `kill`, time limits. Any thread.
std::span<const int> endingSignals() noexcept;

/// Opens a file or a pipe for reading; nullptr and errno if it cannot be opened: EINVAL for a folder or a
/// device, which may never end; EPIPE for a pipe that no program writes to within `pipeWriterTimeout`. Blocks
/// that long, not for a file. Not on the render thread.
std::FILE* openForReading(const std::filesystem::path& path) noexcept;
constexpr std::chrono::seconds pipeWriterTimeout{3};

/// std::fopen for a path; nullptr and errno if it cannot be opened. Not on the render thread.
std::FILE* openStream(const std::filesystem::path& path, const char* mode) noexcept;

} // namespace physvib
