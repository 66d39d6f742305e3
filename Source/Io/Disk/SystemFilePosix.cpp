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

constexpr int always = O_CLOEXEC | O_NONBLOCK | O_NOCTTY; // O_NONBLOCK: opening a pipe would block until its
                                                          // other end is opened
constexpr mode_t asUmaskSays = 0666;

int descriptorOf(std::intptr_t handle) noexcept { return static_cast<int>(handle); }

bool isRegular(int descriptor) noexcept {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

constexpr std::array ending{SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGUSR1, SIGUSR2, SIGXCPU};

} // namespace

SystemFile SystemFile::opened(const std::filesystem::path& path, Opening opening) noexcept {
    constexpr std::array flags{O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW, O_RDWR | O_CREAT,
                               O_RDONLY | O_NOFOLLOW};
    SystemFile file;
    const int descriptor = open(path.c_str(), flags[static_cast<std::size_t>(opening)] | always, asUmaskSays);
    if (!file.note(descriptor >= 0)) return file;
    file.handle_ = descriptor;
    if (isRegular(descriptor)) return file;
    file.refuse();
    if (opening == Opening::create) removeNow(path); // it is this call's, but fstat failed
    return file;
}

void SystemFile::closeNow() noexcept { close(descriptorOf(handle_)); }

SystemFile::Lock SystemFile::lock() noexcept {
    if (flock(descriptorOf(handle_), LOCK_EX | LOCK_NB) == 0) return Lock::taken;
    return errno == EWOULDBLOCK ? Lock::others : Lock::none;
}

bool SystemFile::writeAt(std::int64_t position, std::string_view bytes) noexcept {
    while (error_ == 0 && !bytes.empty()) {
        const ssize_t written = pwrite(descriptorOf(handle_), bytes.data(), bytes.size(), position);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = ENOSPC; // does not occur on present file systems, but would loop forever
        if (!note(written > 0)) break;
        bytes.remove_prefix(static_cast<std::size_t>(written));
        position += written;
    }
    return error_ == 0;
}

// EINVAL: the file system does not support sync
bool SystemFile::sync() noexcept {
    return error_ == 0 && note(fsync(descriptorOf(handle_)) == 0 || errno == EINVAL);
}

int SystemFile::syncFolder(const std::filesystem::path& folder) noexcept {
    const int descriptor = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return 0; // writable, but not readable
    const int error = fsync(descriptor) == 0 ? 0 : errno;
    close(descriptor);
    return error == EIO || error == ENOSPC || error == EDQUOT ? error : 0; // others: not supported
}

bool SystemFile::resize(std::int64_t bytes) noexcept {
    return error_ == 0 && note(ftruncate(descriptorOf(handle_), bytes) == 0);
}

std::int64_t SystemFile::size() noexcept {
    struct stat status {};
    return error_ == 0 && note(fstat(descriptorOf(handle_), &status) == 0) ? status.st_size : 0;
}

bool SystemFile::isAt(Handle handle, const std::filesystem::path& path) noexcept {
    struct stat mine {
    }, there{};
    return fstat(descriptorOf(handle), &mine) == 0 && lstat(path.c_str(), &there) == 0 &&
           mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

void SystemFile::removeNow(const std::filesystem::path& path) noexcept { unlink(path.c_str()); }

void SystemFile::takePermissionsOf(const std::filesystem::path& path) const noexcept {
    struct stat there {};
    if (stat(path.c_str(), &there) == 0 && fchmod(descriptorOf(handle_), there.st_mode & 07777) != 0)
        errno = 0;
}

bool SystemFile::note(bool isGood) noexcept {
    if (!isGood && error_ == 0) error_ = errno;
    return isGood;
}

HeldSignals::HeldSignals() noexcept {
    sigset_t held, before;
    sigemptyset(&held);
    for (const int signal : ending) sigaddset(&held, signal);
    pthread_sigmask(SIG_BLOCK, &held, &before);
    for (std::size_t i = 0; i < ending.size(); ++i)
        if (sigismember(&before, ending[i]) == 1) others_ |= 1u << i;
}

HeldSignals::~HeldSignals() {
    sigset_t held;
    sigemptyset(&held);
    for (std::size_t i = 0; i < ending.size(); ++i)
        if ((others_ >> i & 1u) == 0) sigaddset(&held, ending[i]);
    pthread_sigmask(SIG_UNBLOCK, &held, nullptr);
}

void removeAllOnEnd() noexcept { RemovedOnEnd::removeAll(); }

std::span<const int> endingSignals() noexcept { return ending; }

// Only reading tells a pipe whose writer has said nothing yet (EAGAIN) from one without a writer (0 bytes).
std::FILE* openReadable(const std::filesystem::path& path) noexcept {
    const int descriptor = open(path.c_str(), O_RDONLY | always);
    if (descriptor < 0) return nullptr;
    struct stat status {};
    const bool isPipe = fstat(descriptor, &status) == 0 && S_ISFIFO(status.st_mode);
    std::FILE* const file = isPipe || S_ISREG(status.st_mode) ? fdopen(descriptor, "rb") : nullptr;
    char first = 0;
    pollfd come{descriptor, POLLIN, 0};
    const ssize_t count =
        isPipe && poll(&come, 1, static_cast<int>(std::chrono::milliseconds{writerPatience}.count())) == 0
            ? read(descriptor, &first, 1)
            : ssize_t{-1};
    if (file != nullptr && count != 0) {
        fcntl(descriptor, F_SETFL, O_RDONLY); // from now on reading waits
        if (count == 1) std::ungetc(static_cast<unsigned char>(first), file);
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
