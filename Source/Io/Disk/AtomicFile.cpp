// SPDX-License-Identifier: MIT
// Atomic file writing: creates temporary files beside the target, locks and renames them.
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/FileClash.h"
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

namespace physvib {
namespace {

namespace fs = std::filesystem;
using Lock = SystemFile::Lock;

constexpr const char* temporarySuffix = ".physvib.part"; // of this program only, so leftovers may be removed
constexpr const char* inUseMessage = "it is being written already, here or by another program";
constexpr const char* occupiedMessage = "another program is writing it, or left its temporary file: ";

std::string errorText(int code) { return std::generic_category().message(code); }

/// Opens and closes the file; returns 0 or the error number.
int openErrorNumber(const fs::path& path, const char* mode) {
    std::FILE* const file = openStream(path, mode);
    return file != nullptr && std::fclose(file) == 0 ? 0 : errno;
}

/// Why `target` cannot be written; empty if it can.
std::string writeObstacle(const fs::path& target) {
    std::error_code code;
    const fs::path folder = parentFolder(target);
    if (!target.has_filename()) return "it names a folder, expected a file";
    const bool folderExists = fs::exists(folder, code);
    if (code) return code.message();
    if (!folderExists) return "the folder " + folder.string() + " does not exist";
    const fs::file_status targetStatus = fs::status(target, code);
    if (!fs::exists(targetStatus)) return {};
    if (!fs::is_regular_file(targetStatus))
        return "expected a regular file, found a folder, a device or a pipe";
    const int errorNumber = openErrorNumber(target, "r+b"); // a rename would ignore write protection
    return errorNumber == 0 ? std::string() : errorText(errorNumber);
}

/// Removes the temporary file of a killed program. Locks it first, because a file in use is locked already
/// and must stay. Returns empty, or why it cannot be removed.
std::string removeLeftover(const fs::path& sibling) {
    SystemFile leftover = SystemFile::openForLocking(sibling);
    if (!leftover.isOpen())
        return leftover.error() == ENOENT ? std::string()
                                          : occupiedMessage + sibling.string() + ": " + leftover.reason();
    const Lock lock = leftover.lock();
    if (lock == Lock::heldByOthers) return inUseMessage;
    if (lock == Lock::unsupported) return occupiedMessage + sibling.string();
    std::error_code code;
    if (leftover.isAt(sibling)) fs::remove(sibling, code);
    return code ? occupiedMessage + sibling.string() + ": " + code.message() : std::string();
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path)
    : givenPath_(path)
    , targetPath_(path) {
    if (const std::string reason = prepare(); !reason.empty()) fail(reason);
}

AtomicFile::~AtomicFile() { removeTemporary(); }

bool AtomicFile::writeAt(std::int64_t position, std::string_view bytes) {
    if (error_.empty() && lock_ && file_.size() != writtenBytes_) failIfChanged(), removeTemporary();
    if (!error_.empty()) return false;
    if (file_.writeAt(position, bytes)) {
        writtenBytes_ = std::max(writtenBytes_, position + static_cast<std::int64_t>(bytes.size()));
        return true;
    }
    fail(file_.reason());
    file_.clearError();
    if (lock_ && position > 0) file_.resize(position); // cuts off the partially written block
    removeTemporary();
    return false;
}

const std::string& AtomicFile::write(std::string_view bytes) {
    if (error_.empty()) file_.resize(writtenBytes_ = 0);
    writeAt(0, bytes);
    return error_;
}

const std::string& AtomicFile::publish() {
    if (!error_.empty() || lock_) return error_;
    moveIntoPlace();
    if (!error_.empty()) return removeTemporary(), error_;
    temporaryPath_.clear();
    removeOnSignal_ = RemoveOnSignal();
    lock_ = std::make_unique<AtomicFile>(givenPath_);
    return error_;
}

const std::string& AtomicFile::commit() {
    if (!error_.empty()) return error_;
    moveIntoPlace();
    removeTemporary();
    if (error_.empty() && folderError_ != 0)
        error_ =
            givenPath_.string() + ": its folder cannot be flushed to the disk: " + errorText(folderError_);
    return error_;
}

// After publish() the file is in its place already, and is only checked.
void AtomicFile::moveIntoPlace() {
    std::error_code code;
    if (!lock_) file_.copyPermissionsFrom(targetPath_);
    if (!file_.sync()) {
        fail(file_.reason());
    } else if (lock_) {
        return failIfChanged();
    } else if (!file_.isAt(temporaryPath_) && fs::exists(fs::symlink_status(temporaryPath_, code))) {
        fail("its temporary file was replaced by another");
    } else if (fs::rename(temporaryPath_, targetPath_, code); code) {
        fail(code.message());
    }
    if (error_.empty()) folderError_ = SystemFile::syncFolder(parentFolder(targetPath_));
}

void AtomicFile::failIfChanged() {
    if (const std::string reason = file_.externalChange(targetPath_, writtenBytes_); !reason.empty())
        fail(reason);
}

std::string AtomicFile::prepare() {
    std::error_code code;
    if (fs::is_symlink(givenPath_, code)) {
        if (!isWithin(givenPath_.parent_path(), givenPath_)) return linkLeadsElsewhere;
        targetPath_ = fs::weakly_canonical(givenPath_, code);
        if (code) return code.message();
    }
    if (std::string reason = writeObstacle(targetPath_); !reason.empty()) return reason;
    fs::path sibling = targetPath_;
    return createTemporary(sibling += temporarySuffix);
}

// Retries, because between creation and locking another program may remove the new file as one left behind.
std::string AtomicFile::createTemporary(const fs::path& sibling) {
    constexpr int maxTries = 100;
    for (int i = 0; i < maxTries; ++i) {
        const DeferredSignals deferredSignals;
        SystemFile created = SystemFile::create(sibling);
        if (!created.isOpen() && created.error() != EEXIST) return created.reason();
        if (created.isOpen() && created.lock() != Lock::heldByOthers && created.isAt(sibling)) {
            temporaryPath_ = sibling;
            file_ = std::move(created);
            removeOnSignal_ = RemoveOnSignal(file_, temporaryPath_);
            return {};
        }
        if (std::string reason = removeLeftover(sibling); !reason.empty()) return reason;
    }
    return inUseMessage;
}

void AtomicFile::fail(std::string_view reason) {
    error_ = givenPath_.string() + ": cannot be written: ";
    error_ += reason;
}

void AtomicFile::removeTemporary() noexcept {
    std::error_code ignored;
    if (file_.isOpen() && file_.isAt(temporaryPath_)) fs::remove(temporaryPath_, ignored);
    temporaryPath_.clear();
    removeOnSignal_ = RemoveOnSignal();
    file_ = SystemFile(); // which also releases the lock
    lock_.reset();
}

std::string writeFile(const fs::path& path, std::string_view bytes) {
    AtomicFile file(path);
    file.write(bytes);
    return file.commit();
}

} // namespace physvib
