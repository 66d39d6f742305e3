// SPDX-License-Identifier: MIT
// An open file of the system, with its lock: what the rooms without JUCE ask of the system beside a board's
// line. One file per system does it, SystemFilePosix.cpp and SystemFileWindows.cpp; nothing else of them
// knows where it runs.
#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// A regular file that stays open, so that no other file can take its name's place unnoticed. The first error
/// stays and refuses what follows. One thread at a time, not R.
class SystemFile {
public:
    /// A new file; an error if there is anything of that name already, a link as well.
    static SystemFile create(const std::filesystem::path& path);

    /// What is there, to grow, or a new one. A link is followed, unless it leads out of its folder; a pipe or
    /// a device is an error, and is not waited for.
    static SystemFile grow(const std::filesystem::path& path);

    /// What is there, only to lock it and to ask what it is; no link.
    static SystemFile look(const std::filesystem::path& path);

    SystemFile() = default;
    SystemFile(SystemFile&& other) noexcept;
    SystemFile& operator=(SystemFile&& other) noexcept;
    ~SystemFile();

    bool isOpen() const noexcept { return handle_ != none; }
    /// The first error number (of errno, everywhere), 0 if there was none; and in words.
    int error() const noexcept { return error_; }
    std::string reason() const;
    /// What follows is tried again: a full disk may have room by now.
    void forgetError() noexcept { error_ = isOpen() ? 0 : error_; }

    enum class Lock { taken, others, none }; ///< none: the file system has no locks
    /// Nobody else may lock it until it is closed, which any end of the program does.
    Lock lock() noexcept;

    /// All of `bytes` at their place, or false.
    bool writeAt(std::int64_t position, std::string_view bytes) noexcept;

    /// All of `bytes` at the end; or false, and the end is where it was.
    bool append(std::string_view bytes) noexcept;

    /// All that was written is on the disk, whatever becomes of the machine; or false. Waits for the disk.
    bool sync() noexcept;

    bool resize(std::int64_t bytes) noexcept;
    std::int64_t size() noexcept; ///< 0 after an error

    /// Whether it is the file of that name, itself or through nothing but folders.
    bool isAt(const std::filesystem::path& path) const noexcept;

    /// May be read and written by whom `path` may. Best effort: another owner's permissions cannot always be
    /// copied, and on Windows a new file's are its folder's.
    void takePermissionsOf(const std::filesystem::path& path) const noexcept;

    /// So are the names in a folder: of what was made or renamed in it. Where a system knows no such thing,
    /// nothing happens.
    static void syncFolder(const std::filesystem::path& folder) noexcept;

private:
    friend class RemovedOnEnd;
    using Handle = std::intptr_t; // POSIX: a descriptor
    static constexpr Handle none = -1;
    enum class Opening { create, grow, look };
    static SystemFile opened(const std::filesystem::path& path, Opening opening) noexcept;
    static bool isAt(Handle handle, const std::filesystem::path& path) noexcept;
    static void removeNow(const std::filesystem::path& path) noexcept; // calls the system, and nothing else
    void closeNow() noexcept;
    void refuse() noexcept;          // is none of the files that this class is for
    bool note(bool isGood) noexcept; // keeps the system's first error

    Handle handle_ = none;
    int error_ = 0;
};

/// Removes a file if a signal ends the program (see removeAllOnEnd()); until this object goes. Any thread but
/// R.
class RemovedOnEnd {
public:
    RemovedOnEnd() = default;
    /// `file`, which outlives this object, if it is still what has that name then.
    RemovedOnEnd(const SystemFile& file, const std::filesystem::path& name);
    RemovedOnEnd(RemovedOnEnd&& other) noexcept;
    RemovedOnEnd& operator=(RemovedOnEnd&& other) noexcept;
    ~RemovedOnEnd();

private:
    friend void removeAllOnEnd() noexcept;
    struct Removal;
    static void removeAll() noexcept;
    static std::array<std::atomic<Removal*>, 256> removals; // whoever takes one out of its slot owns it: the
                                                            // handler of a signal frees none
    int slot_ = -1;
};

/// While it lives, what ends the program waits (a signal; on Windows the console's, which comes on a thread
/// of its own): between making a file and being ready to remove it. Any thread but R; for the thread that
/// made it.
class HeldSignals {
public:
    HeldSignals() noexcept;
    ~HeldSignals();
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

private:
    unsigned others_ = 0; // those that were held already
};

/// For the handler of a signal that ends the program: allocates, locks and waits for nothing (on Windows it
/// waits for HeldSignals).
void removeAllOnEnd() noexcept;

/// What asks a program to end: Ctrl-C, `kill`, a terminal that is closed. Any thread.
std::span<const int> endingSignals() noexcept;

/// A file of that name by the C library, as std::fopen; nullptr and errno if it cannot be opened. Any thread
/// but R.
std::FILE* openStream(const std::filesystem::path& path, const char* mode) noexcept;

} // namespace physvib
