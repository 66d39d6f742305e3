// SPDX-License-Identifier: MIT
// Implementation of atomic file writing: temporary files beside the target, locks, renames, and error
// messages.
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

constexpr const char* suffix = ".physvib.part"; // only this program uses it, so leftovers may be removed
constexpr const char* beingWritten = "it is being written already, here or by another program";
constexpr const char* inTheWay = "another program is writing it, or left its temporary file: ";

std::string reasonOf(int code) { return std::generic_category().message(code); }

/// Opens and closes the file; returns 0 or the error number.
int tryOpen(const fs::path& path, const char* mode) {
    std::FILE* const file = openStream(path, mode);
    return file != nullptr && std::fclose(file) == 0 ? 0 : errno;
}

/// Why `target` cannot be written; empty if it can.
std::string obstacle(const fs::path& target) {
    std::error_code code;
    const fs::path folder = folderOf(target);
    if (!target.has_filename()) return "it names a folder, expected a file";
    const bool isThere = fs::exists(folder, code);
    if (code) return code.message();
    if (!isThere) return "the folder " + folder.string() + " does not exist";
    const fs::file_status present = fs::status(target, code);
    if (!fs::exists(present)) return {};
    if (!fs::is_regular_file(present)) return "expected a regular file, found a folder, a device or a pipe";
    const int denied = tryOpen(target, "r+b"); // a rename would ignore write protection
    return denied == 0 ? std::string() : reasonOf(denied);
}

/// Removes the temporary file of a killed program, which is not locked. It is locked before it is removed, so
/// no file in use is removed. Empty, or the obstacle.
std::string removeLeftBehind(const fs::path& sibling) {
    SystemFile left = SystemFile::look(sibling);
    if (!left.isOpen())
        return left.error() == ENOENT ? std::string() : inTheWay + sibling.string() + ": " + left.reason();
    const Lock lock = left.lock();
    if (lock == Lock::others) return beingWritten;
    if (lock == Lock::none) return inTheWay + sibling.string();
    std::error_code code;
    if (left.isAt(sibling)) fs::remove(sibling, code);
    return code ? inTheWay + sibling.string() + ": " + code.message() : std::string();
}

} // namespace

AtomicFile::AtomicFile(const fs::path& path)
    : named_(path)
    , target_(path) {
    if (const std::string reason = prepare(); !reason.empty()) fail(reason);
}

AtomicFile::~AtomicFile() { removeTemporary(); }

bool AtomicFile::writeAt(std::int64_t position, std::string_view bytes) {
    if (error_.empty() && lock_ && file_.size() != bytes_) failIfChanged(), removeTemporary();
    if (!error_.empty()) return false;
    if (file_.writeAt(position, bytes)) {
        bytes_ = std::max(bytes_, position + static_cast<std::int64_t>(bytes.size()));
        return true;
    }
    fail(file_.reason());
    file_.forgetError();
    if (lock_ && position > 0) file_.resize(position); // cuts off the partially written block
    removeTemporary();
    return false;
}

const std::string& AtomicFile::write(std::string_view bytes) {
    if (error_.empty()) file_.resize(bytes_ = 0);
    writeAt(0, bytes);
    return error_;
}

const std::string& AtomicFile::show() {
    if (!error_.empty() || lock_) return error_;
    place();
    if (!error_.empty()) return removeTemporary(), error_;
    temporary_.clear();
    onEnd_ = RemovedOnEnd();
    lock_ = std::make_unique<AtomicFile>(named_);
    return error_;
}

const std::string& AtomicFile::commit() {
    if (!error_.empty()) return error_;
    place();
    removeTemporary();
    if (error_.empty() && folderError_ != 0)
        error_ = named_.string() + ": its folder cannot be flushed to the disk: " + reasonOf(folderError_);
    return error_;
}

// A file after show() is in its place already.
void AtomicFile::place() {
    std::error_code code;
    if (!lock_) file_.takePermissionsOf(target_);
    if (!file_.sync()) {
        fail(file_.reason());
    } else if (lock_) {
        return failIfChanged();
    } else if (!file_.isAt(temporary_) && fs::exists(fs::symlink_status(temporary_, code))) {
        fail("its temporary file was replaced by another");
    } else if (fs::rename(temporary_, target_, code); code) {
        fail(code.message());
    }
    if (error_.empty()) folderError_ = SystemFile::syncFolder(folderOf(target_));
}

void AtomicFile::failIfChanged() {
    if (const std::string change = file_.changeByOthers(target_, bytes_); !change.empty()) fail(change);
}

std::string AtomicFile::prepare() {
    std::error_code code;
    if (fs::is_symlink(named_, code)) {
        if (!isWithin(named_.parent_path(), named_)) return leadsElsewhere;
        target_ = fs::weakly_canonical(named_, code);
        if (code) return code.message();
    }
    if (std::string reason = obstacle(target_); !reason.empty()) return reason;
    fs::path sibling = target_;
    return make(sibling += suffix);
}

// Retries, because between creation and locking another program may remove the new file as one left behind.
std::string AtomicFile::make(const fs::path& sibling) {
    constexpr int mostTries = 100;
    for (int i = 0; i < mostTries; ++i) {
        const HeldSignals held;
        SystemFile made = SystemFile::create(sibling);
        if (!made.isOpen() && made.error() != EEXIST) return made.reason();
        if (made.isOpen() && made.lock() != Lock::others && made.isAt(sibling)) {
            temporary_ = sibling;
            file_ = std::move(made);
            onEnd_ = RemovedOnEnd(file_, temporary_);
            return {};
        }
        if (std::string reason = removeLeftBehind(sibling); !reason.empty()) return reason;
    }
    return beingWritten;
}

void AtomicFile::fail(std::string_view reason) {
    error_ = named_.string() + ": cannot be written: ";
    error_ += reason;
}

void AtomicFile::removeTemporary() noexcept {
    std::error_code ignored;
    if (file_.isOpen() && file_.isAt(temporary_)) fs::remove(temporary_, ignored);
    temporary_.clear();
    onEnd_ = RemovedOnEnd();
    file_ = SystemFile(); // which also releases the lock
    lock_.reset();
}

std::string writeFile(const fs::path& path, std::string_view bytes) {
    AtomicFile file(path);
    file.write(bytes);
    return file.commit();
}

} // namespace physvib
