// SPDX-License-Identifier: MIT
// SystemFile on Windows: CreateFile, WriteFile, LockFileEx. Other programs may rename and remove open files,
// as on POSIX.
#if defined(_WIN32)
#include "Io/Disk/SystemFile.h"
#include "Io/Disk/SystemWindows.h"
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cwchar>

namespace physvib {
namespace {

constexpr DWORD shareMode = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
constexpr std::int64_t lockedPosition = 0x7fff'ffff'ffff'fff0; // Windows locks block readers too, so it locks
                                                               // a byte beyond any file's end

SRWLOCK creationLock = SRWLOCK_INIT; // DeferredSignals lock it shared, removeFilesOnSignal exclusively

HANDLE handleOf(std::intptr_t handle) noexcept { return reinterpret_cast<HANDLE>(handle); }

OVERLAPPED overlappedAt(std::int64_t position) noexcept {
    OVERLAPPED overlapped{};
    overlapped.Offset = static_cast<DWORD>(position & 0xffff'ffff);
    overlapped.OffsetHigh = static_cast<DWORD>(position >> 32);
    return overlapped;
}

int errnoOf(DWORD error) noexcept {
    switch (error) {
    case ERROR_FILE_EXISTS:
    case ERROR_ALREADY_EXISTS: return EEXIST;
    case ERROR_FILE_NOT_FOUND:
    case ERROR_PATH_NOT_FOUND:
    case ERROR_INVALID_NAME: return ENOENT;
    case ERROR_ACCESS_DENIED:
    case ERROR_WRITE_PROTECT: return EACCES;
    case ERROR_SHARING_VIOLATION:
    case ERROR_LOCK_VIOLATION: return EBUSY;
    case ERROR_HANDLE_DISK_FULL:
    case ERROR_DISK_FULL: return ENOSPC;
    case ERROR_FILE_TOO_LARGE: return EFBIG;
    case ERROR_TOO_MANY_OPEN_FILES: return EMFILE;
    default: return EIO;
    }
}

bool getIdentity(HANDLE file, BY_HANDLE_FILE_INFORMATION& identity) noexcept {
    return GetFileInformationByHandle(file, &identity) != 0;
}

bool getIdentity(const std::filesystem::path& path, BY_HANDLE_FILE_INFORMATION& identity) noexcept {
    const HANDLE file = CreateFileW(path.c_str(), 0, shareMode, nullptr, OPEN_EXISTING,
                                    FILE_FLAG_OPEN_REPARSE_POINT | FILE_FLAG_BACKUP_SEMANTICS, nullptr);
    if (file == INVALID_HANDLE_VALUE) return false;
    const bool hasIdentity = getIdentity(file, identity);
    CloseHandle(file);
    return hasIdentity;
}

bool isRegular(HANDLE file, bool followsLinks) noexcept {
    BY_HANDLE_FILE_INFORMATION identity;
    if (GetFileType(file) != FILE_TYPE_DISK || !getIdentity(file, identity)) return false;
    return followsLinks || (identity.dwFileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) == 0;
}

bool isFolder(const std::filesystem::path& path) noexcept {
    const DWORD attributes = GetFileAttributesW(path.c_str());
    return attributes != INVALID_FILE_ATTRIBUTES && (attributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
}

} // namespace

SystemFile SystemFile::openWith(const std::filesystem::path& path, Opening opening) noexcept {
    const bool isLockOnly = opening == Opening::lockOnly, creates = opening == Opening::create;
    SystemFile file;
    file.handle_ = reinterpret_cast<Handle>(CreateFileW(
        path.c_str(), isLockOnly ? GENERIC_READ : GENERIC_READ | GENERIC_WRITE, shareMode, nullptr,
        creates      ? CREATE_NEW
        : isLockOnly ? OPEN_EXISTING
                     : OPEN_ALWAYS,
        FILE_ATTRIBUTE_NORMAL | (isLockOnly ? FILE_FLAG_OPEN_REPARSE_POINT : 0), nullptr));
    if (!file.recordError(file.isOpen())) {
        if (!creates && isFolder(path)) file.error_ = EINVAL; // Windows reports "access denied" for a folder
    } else if (!isRegular(handleOf(file.handle_), !isLockOnly)) {
        file.closeAsIrregular();
    }
    return file;
}

void SystemFile::closeHandle() noexcept { CloseHandle(handleOf(handle_)); }

SystemFile::Lock SystemFile::lock() noexcept {
    OVERLAPPED overlapped = overlappedAt(lockedPosition);
    if (LockFileEx(handleOf(handle_), LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0,
                   &overlapped) != 0)
        return Lock::acquired;
    const DWORD error = GetLastError();
    return error == ERROR_LOCK_VIOLATION || error == ERROR_IO_PENDING ? Lock::heldByOthers
                                                                      : Lock::unsupported;
}

bool SystemFile::writeAt(std::int64_t position, std::string_view bytes) noexcept {
    constexpr std::size_t maxBlockBytes = 1u << 30;
    while (error_ == 0 && !bytes.empty()) {
        OVERLAPPED overlapped = overlappedAt(position);
        DWORD written = 0;
        if (!recordError(WriteFile(handleOf(handle_), bytes.data(),
                                   static_cast<DWORD>(std::min(bytes.size(), maxBlockBytes)), &written,
                                   &overlapped) != 0))
            break;
        if (written == 0) error_ = ENOSPC; // otherwise it would loop forever
        bytes.remove_prefix(written);
        position += written;
    }
    return error_ == 0;
}

bool SystemFile::sync() noexcept {
    return error_ == 0 && recordError(FlushFileBuffers(handleOf(handle_)) != 0);
}

int SystemFile::syncFolder(const std::filesystem::path&) noexcept { return 0; } // NTFS journals its names

bool SystemFile::resize(std::int64_t bytes) noexcept {
    FILE_END_OF_FILE_INFO end{};
    end.EndOfFile.QuadPart = bytes;
    return error_ == 0 && recordError(SetFileInformationByHandle(handleOf(handle_), FileEndOfFileInfo, &end,
                                                                 sizeof(end)) != 0);
}

std::int64_t SystemFile::size() noexcept {
    LARGE_INTEGER bytes{};
    return error_ == 0 && recordError(GetFileSizeEx(handleOf(handle_), &bytes) != 0) ? bytes.QuadPart : 0;
}

bool SystemFile::isAt(Handle handle, const std::filesystem::path& path) noexcept {
    BY_HANDLE_FILE_INFORMATION ownIdentity, pathIdentity;
    return getIdentity(handleOf(handle), ownIdentity) && getIdentity(path, pathIdentity) &&
           ownIdentity.dwVolumeSerialNumber == pathIdentity.dwVolumeSerialNumber &&
           ownIdentity.nFileIndexHigh == pathIdentity.nFileIndexHigh &&
           ownIdentity.nFileIndexLow == pathIdentity.nFileIndexLow;
}

void SystemFile::removePath(const std::filesystem::path& path) noexcept { DeleteFileW(path.c_str()); }

void SystemFile::copyPermissionsFrom(const std::filesystem::path&) const noexcept {}

bool SystemFile::recordError(bool isOk) noexcept {
    if (!isOk && error_ == 0) error_ = errnoOf(GetLastError());
    return isOk;
}

DeferredSignals::DeferredSignals() noexcept { AcquireSRWLockShared(&creationLock); }
DeferredSignals::~DeferredSignals() { ReleaseSRWLockShared(&creationLock); }

std::span<const int> endingSignals() noexcept {
    static constexpr int ending[]{SIGINT, SIGTERM, SIGBREAK};
    return ending;
}

void removeFilesOnSignal() noexcept {
    AcquireSRWLockExclusive(&creationLock);
    RemoveOnSignal::removeAll();
    ReleaseSRWLockExclusive(&creationLock);
}

std::FILE* openForReading(const std::filesystem::path& path) noexcept { return openStream(path, "rb"); }

std::FILE* openStream(const std::filesystem::path& path, const char* mode) noexcept {
    wchar_t wide[8]{};
    std::mbstowcs(wide, mode, std::size(wide) - 1);
    return _wfopen(path.c_str(), wide);
}

} // namespace physvib
#endif
