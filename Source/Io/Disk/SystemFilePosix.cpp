// SPDX-License-Identifier: MIT
// SystemFile on POSIX: open, pwrite, flock, fstat.
#if !defined(_WIN32)
#include "Io/Disk/SystemFile.h"
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace physvib {
namespace {

constexpr int commonFlags = O_CLOEXEC | O_NONBLOCK | O_NOCTTY; // O_NONBLOCK: opening a pipe would block until
                                                               // its other end is opened
constexpr mode_t defaultMode = 0666;

int descriptorOf(std::intptr_t handle) noexcept { return static_cast<int>(handle); }

bool isRegular(int descriptor) noexcept {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

constexpr std::array fatalSignals{SIGINT,  SIGTERM, SIGHUP,  SIGQUIT, SIGPIPE,
                                  SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU};

} // namespace

SystemFile SystemFile::openWith(const std::filesystem::path& path, Opening opening) noexcept {
    constexpr std::array flags{O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW, O_RDWR | O_CREAT,
                               O_RDONLY | O_NOFOLLOW};
    SystemFile file;
    const int descriptor =
        open(path.c_str(), flags[static_cast<std::size_t>(opening)] | commonFlags, defaultMode);
    if (!file.recordError(descriptor >= 0)) return file;
    file.handle_ = descriptor;
    if (isRegular(descriptor)) return file;
    file.closeAsIrregular();
    if (opening == Opening::create) removePath(path); // it was created here, but fstat failed
    return file;
}

void SystemFile::closeHandle() noexcept { close(descriptorOf(handle_)); }

SystemFile::Lock SystemFile::lock() noexcept {
    if (flock(descriptorOf(handle_), LOCK_EX | LOCK_NB) == 0) return Lock::acquired;
    return errno == EWOULDBLOCK ? Lock::heldByOthers : Lock::unsupported;
}

bool SystemFile::writeAt(std::int64_t position, std::string_view bytes) noexcept {
    while (error_ == 0 && !bytes.empty()) {
        const ssize_t written = pwrite(descriptorOf(handle_), bytes.data(), bytes.size(), position);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = ENOSPC; // not seen on present file systems, but it would loop forever
        if (!recordError(written > 0)) break;
        bytes.remove_prefix(static_cast<std::size_t>(written));
        position += written;
    }
    return error_ == 0;
}

// EINVAL: the file system does not support sync
bool SystemFile::sync() noexcept {
    return error_ == 0 && recordError(fsync(descriptorOf(handle_)) == 0 || errno == EINVAL);
}

int SystemFile::syncFolder(const std::filesystem::path& folder) noexcept {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return 0; // a folder that is writable but not readable
    const int error = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    return error == EIO || error == ENOSPC || error == EDQUOT ? error : 0; // other errors: not supported
}

bool SystemFile::resize(std::int64_t bytes) noexcept {
    return error_ == 0 && recordError(ftruncate(descriptorOf(handle_), bytes) == 0);
}

std::int64_t SystemFile::size() noexcept {
    struct stat status {};
    return error_ == 0 && recordError(fstat(descriptorOf(handle_), &status) == 0) ? status.st_size : 0;
}

bool SystemFile::isAt(Handle handle, const std::filesystem::path& path) noexcept {
    struct stat ownStatus {
    }, pathStatus{};
    return fstat(descriptorOf(handle), &ownStatus) == 0 && lstat(path.c_str(), &pathStatus) == 0 &&
           ownStatus.st_dev == pathStatus.st_dev && ownStatus.st_ino == pathStatus.st_ino;
}

void SystemFile::removePath(const std::filesystem::path& path) noexcept { unlink(path.c_str()); }

void SystemFile::copyPermissionsFrom(const std::filesystem::path& path) const noexcept {
    struct stat pathStatus {};
    if (stat(path.c_str(), &pathStatus) == 0 &&
        fchmod(descriptorOf(handle_), pathStatus.st_mode & 07777) != 0)
        errno = 0;
}

bool SystemFile::recordError(bool isOk) noexcept {
    if (!isOk && error_ == 0) error_ = errno;
    return isOk;
}

DeferredSignals::DeferredSignals() noexcept {
    sigset_t deferred, blocked;
    sigemptyset(&deferred);
    for (const int signal : fatalSignals) sigaddset(&deferred, signal);
    pthread_sigmask(SIG_BLOCK, &deferred, &blocked);
    for (std::size_t i = 0; i < fatalSignals.size(); ++i)
        if (sigismember(&blocked, fatalSignals[i]) == 1) blockedBefore_ |= 1u << i;
}

DeferredSignals::~DeferredSignals() {
    sigset_t deferred;
    sigemptyset(&deferred);
    for (std::size_t i = 0; i < fatalSignals.size(); ++i)
        if ((blockedBefore_ >> i & 1u) == 0) sigaddset(&deferred, fatalSignals[i]);
    pthread_sigmask(SIG_UNBLOCK, &deferred, nullptr);
}

void removeFilesOnSignal() noexcept { RemoveOnSignal::removeAll(); }

std::span<const int> endingSignals() noexcept { return fatalSignals; }

// Waits for a pipe's writer. poll() cannot tell a writer that is silent from none; read() can: it fails with
// EAGAIN for the first and returns 0 bytes for the second.
std::FILE* openForReading(const std::filesystem::path& path) noexcept {
    const int descriptor = open(path.c_str(), O_RDONLY | commonFlags);
    if (descriptor < 0) return nullptr;
    struct stat status {};
    const bool isPipe = fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode);
    std::FILE* const file = isPipe || S_ISREG(status.st_mode) ? fdopen(descriptor, "rb") : nullptr;
    char firstByte = 0;
    pollfd input{descriptor, POLLIN, 0};
    const ssize_t count =
        isPipe && poll(&input, 1, static_cast<int>(std::chrono::milliseconds{pipeWriterTimeout}.count())) == 0
            ? read(descriptor, &firstByte, 1)
            : ssize_t{-1};
    if (file != nullptr && count != 0) {
        fcntl(descriptor, F_SETFL, O_RDONLY); // from now on reading waits
        if (count == 1) std::ungetc(static_cast<unsigned char>(firstByte), file);
        return file;
    }
    file == nullptr ? close(descriptor) : std::fclose(file);
    errno = file == nullptr ? EINVAL : EPIPE;
    return nullptr;
}

std::FILE* openStream(const std::filesystem::path& path, const char* mode) noexcept {
    return std::fopen(path.c_str(), mode);
}

} // namespace physvib
#endif
