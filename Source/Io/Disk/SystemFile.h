// SPDX-License-Identifier: MIT
// An open file with a lock, by direct system calls. SystemFilePosix.cpp and SystemFileWindows.cpp implement
// it; with a board's serial line it is all that the modules without JUCE need of the operating system.
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
/// later operations fail. One thread at a time, not the render thread (R).
class SystemFile {
public:
    /// Creates a new file; an error if the name exists, even as a link.
    static SystemFile create(const std::filesystem::path& path);

    /// Opens an existing file for appending, or creates it. A link is followed unless it leads out of its
    /// folder; a pipe or a device is an error and does not block.
    static SystemFile grow(const std::filesystem::path& path);

    /// Opens an existing file only to lock and identify it; links are refused.
    static SystemFile look(const std::filesystem::path& path);

    SystemFile() = default;
    SystemFile(SystemFile&& other) noexcept;
    SystemFile& operator=(SystemFile&& other) noexcept;
    ~SystemFile();

    bool isOpen() const noexcept { return handle_ != none; }
    /// The first error number (of errno, on every system), 0 if there was none; reason(): as text.
    int error() const noexcept { return error_; }
    std::string reason() const;
    /// Allows a retry: a full disk may have space again.
    void forgetError() noexcept { error_ = isOpen() ? 0 : error_; }

    enum class Lock { taken, others, none }; ///< none: the file system has no locks
    /// Prevents other programs from locking it, until it is closed or the program ends.
    Lock lock() noexcept;

    /// Writes all of `bytes` at that position; false on failure.
    bool writeAt(std::int64_t position, std::string_view bytes) noexcept;

    /// Appends all of `bytes`; on failure false, and the length is unchanged.
    bool append(std::string_view bytes) noexcept;

    /// Flushes to disk, so that the data survives a power failure; false on failure. Blocks.
    bool sync() noexcept;

    bool resize(std::int64_t bytes) noexcept;
    std::int64_t size() noexcept; ///< 0 after an error

    /// True if `path` names this very file, not through a link.
    bool isAt(const std::filesystem::path& path) const noexcept;

    /// Empty, or how another program changed this file, which is at `path` or where a link there leads and
    /// had `bytes` bytes: it was removed or replaced, or its length changed.
    std::string changeByOthers(const std::filesystem::path& path, std::int64_t bytes);

    /// Copies permissions from `path`. Best effort: another owner's permissions cannot always be copied, and
    /// on Windows a new file has its folder's.
    void takePermissionsOf(const std::filesystem::path& path) const noexcept;

    /// Flushes the names in a folder after a file was created or renamed. Returns 0, also on systems without
    /// that, or the error number if the disk failed.
    static int syncFolder(const std::filesystem::path& folder) noexcept;

private:
    friend class RemovedOnEnd;
    using Handle = std::intptr_t; // POSIX: a descriptor
    static constexpr Handle none = -1;
    enum class Opening { create, grow, look };
    static SystemFile opened(const std::filesystem::path& path, Opening opening) noexcept;
    static bool isAt(Handle handle, const std::filesystem::path& path) noexcept;
    static void removeNow(const std::filesystem::path& path) noexcept; // one system call, nothing else
    void closeNow() noexcept;
    void refuse() noexcept;          // refuses files that are not regular
    bool note(bool isGood) noexcept; // records the first system error

    Handle handle_ = none;
    int error_ = 0;
};

/// While it exists, removes a file if a signal ends the program (see removeAllOnEnd()). Any thread but R.
class RemovedOnEnd {
public:
    RemovedOnEnd() = default;
    /// `file` must outlive this object; it is removed only if `name` still refers to it.
    RemovedOnEnd(const SystemFile& file, const std::filesystem::path& name);
    RemovedOnEnd(RemovedOnEnd&& other) noexcept;
    RemovedOnEnd& operator=(RemovedOnEnd&& other) noexcept;
    ~RemovedOnEnd();

private:
    friend void removeAllOnEnd() noexcept;
    struct Removal;
    static void removeAll() noexcept;
    static std::array<std::atomic<Removal*>, 256> removals; // the thread that takes an entry out of its slot
                                                            // owns it; a signal handler frees none
    int slot_ = -1;
};

/// While it exists, signals that end the program (on Windows console events, which arrive on their own
/// thread) are deferred: covers the time between creating a file and registering its removal. Any thread but
/// R; for its own thread.
class HeldSignals {
public:
    HeldSignals() noexcept;
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

private:
    unsigned others_ = 0; // signals that were blocked already
};

/// For the handler of a signal that ends the program: no allocation, lock or wait (Windows: for HeldSignals).
void removeAllOnEnd() noexcept;

/// The signals that end a program unless it handles them: Ctrl-C, `kill`, a closed terminal, time limits. Any
/// thread.
std::span<const int> endingSignals() noexcept;

/// Opens a file or a pipe for reading; nullptr and errno if it cannot be opened: EINVAL for a folder or a
/// device, which may never end; EPIPE for a pipe that no program writes to within `writerPatience`. Blocks
/// that long, not for a file. Any thread but R.
std::FILE* openReadable(const std::filesystem::path& path) noexcept;
constexpr std::chrono::seconds writerPatience{3};

/// std::fopen for a path; nullptr and errno if it cannot be opened. Any thread but R.
std::FILE* openStream(const std::filesystem::path& path, const char* mode) noexcept;

} // namespace physvib
