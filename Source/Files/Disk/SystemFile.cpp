// SPDX-License-Identifier: MIT
// POSIX: open, pwrite, flock, fstat.
#include "Files/Disk/SystemFile.h"
#include <array>
#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <memory>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace physvib {
namespace {

constexpr int always = O_CLOEXEC | O_NONBLOCK | O_NOCTTY; // O_NONBLOCK: opening a pipe would wait for its other end
constexpr mode_t asUmaskSays = 0666;

bool isRegular(int descriptor) noexcept {
    struct stat status {};
    return fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode);
}

bool isFileAt(int descriptor, const char* path) noexcept {
    struct stat mine {}, there {};
    return fstat(descriptor, &mine) == 0 && lstat(path, &there) == 0 && mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
}

struct Removal {
    int descriptor;
    std::string name;
};

// Whoever takes a removal out of its slot owns it: the handler of a signal frees none.
std::array<std::atomic<Removal*>, 256> removals{};

} // namespace

SystemFile::SystemFile(const std::filesystem::path& path, int flags) noexcept
    : descriptor_{open(path.c_str(), flags | always, asUmaskSays)} {
    if (!note(descriptor_ >= 0) || isRegular(descriptor_)) return;
    close(std::exchange(descriptor_, -1));
    error_ = EINVAL;
}

SystemFile SystemFile::create(const std::filesystem::path& path) { return {path, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW}; }
SystemFile SystemFile::grow(const std::filesystem::path& path) { return {path, O_RDWR | O_CREAT}; }
SystemFile SystemFile::look(const std::filesystem::path& path) { return {path, O_RDONLY | O_NOFOLLOW}; }

SystemFile::SystemFile(SystemFile&& other) noexcept
    : descriptor_{std::exchange(other.descriptor_, -1)}
    , error_{std::exchange(other.error_, 0)} {}

SystemFile& SystemFile::operator=(SystemFile&& other) noexcept {
    std::swap(descriptor_, other.descriptor_);
    std::swap(error_, other.error_);
    return *this;
}

SystemFile::~SystemFile() {
    if (isOpen()) close(descriptor_);
}

std::string SystemFile::reason() const {
    if (error_ == EINVAL) return "expected a regular file, found a folder, a device or a pipe";
    return error_ == 0 ? std::string{} : std::generic_category().message(error_);
}

SystemFile::Lock SystemFile::lock() noexcept {
    if (flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return Lock::taken;
    return errno == EWOULDBLOCK ? Lock::others : Lock::none;
}

bool SystemFile::writeAt(std::int64_t position, std::string_view bytes) noexcept {
    while (error_ == 0 && !bytes.empty()) {
        const ssize_t written = pwrite(descriptor_, bytes.data(), bytes.size(), position);
        if (written < 0 && errno == EINTR) continue;
        if (written == 0) errno = ENOSPC; // no file system of today, but it would never end
        if (!note(written > 0)) break;
        bytes.remove_prefix(static_cast<std::size_t>(written));
        position += written;
    }
    return error_ == 0;
}

bool SystemFile::append(std::string_view bytes) noexcept {
    const std::int64_t end = size();
    if (error_ != 0 || writeAt(end, bytes)) return error_ == 0;
    [[maybe_unused]] const int cut = ftruncate(descriptor_, end); // the first error is what counts
    return false;
}

bool SystemFile::resize(std::int64_t bytes) noexcept { return error_ == 0 && note(ftruncate(descriptor_, bytes) == 0); }

std::int64_t SystemFile::size() noexcept {
    struct stat status {};
    return error_ == 0 && note(fstat(descriptor_, &status) == 0) ? status.st_size : 0;
}

bool SystemFile::isAt(const std::filesystem::path& path) const noexcept { return isFileAt(descriptor_, path.c_str()); }

void SystemFile::takePermissionsOf(const std::filesystem::path& path) const noexcept {
    struct stat there {};
    if (stat(path.c_str(), &there) == 0 && fchmod(descriptor_, there.st_mode & 07777) != 0) errno = 0;
}

bool SystemFile::note(bool isGood) noexcept {
    if (!isGood && error_ == 0) error_ = errno;
    return isGood;
}

RemovedOnEnd::RemovedOnEnd(const SystemFile& file, const std::filesystem::path& name) {
    auto removal = std::make_unique<Removal>(Removal{file.descriptor_, std::filesystem::absolute(name).string()});
    for (std::size_t i = 0; i < removals.size() && slot_ < 0; ++i) {
        Removal* none = nullptr;
        if (removals[i].compare_exchange_strong(none, removal.get())) slot_ = static_cast<int>(i);
    }
    if (slot_ >= 0) removal.release(); // else there are more files at once than any call writes
}

RemovedOnEnd::RemovedOnEnd(RemovedOnEnd&& other) noexcept : slot_{std::exchange(other.slot_, -1)} {}

RemovedOnEnd& RemovedOnEnd::operator=(RemovedOnEnd&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

RemovedOnEnd::~RemovedOnEnd() {
    if (slot_ >= 0) delete removals[static_cast<std::size_t>(slot_)].exchange(nullptr);
}

HeldSignals::HeldSignals() noexcept {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaddset(&ending, signal);
    pthread_sigmask(SIG_BLOCK, &ending, &before_);
}

HeldSignals::~HeldSignals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }

void removeAllOnEnd() noexcept {
    for (auto& slot : removals)
        if (const Removal* const removal = slot.exchange(nullptr); removal && isFileAt(removal->descriptor, removal->name.c_str())) unlink(removal->name.c_str());
}

} // namespace physvib
