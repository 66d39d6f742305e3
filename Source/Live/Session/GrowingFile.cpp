// SPDX-License-Identifier: MIT
// Appends all pending lines at once, or keeps them pending if the disk fails.
#include "Live/Session/GrowingFile.h"

namespace physvib {

void GrowingFile::open(const std::filesystem::path& path) {
    path_ = path;
    file_ = SystemFile::grow(path);
    if (file_.error() != 0)
        fail(file_.reason());
    else if (file_.lock() == SystemFile::Lock::others)
        fail("it is being written already");
    bytes_ = file_.size();
}

bool GrowingFile::sync() {
    if (!error_.empty()) return true;
    if (!file_.sync()) fail(file_.reason());
    const auto change = file_.changeByOthers(path_, bytes_);
    if (!change.empty()) fail(change);
    return change.empty();
}

void GrowingFile::append(std::string_view lines) {
    if (isOver_) return;
    if (waiting_.size() + lines.size() > maxWaitingBytes) {
        isOver_ = true;
        waiting_ = {};
        error_ += "; too much would have to wait, so it ends here";
        return;
    }
    waiting_ += lines;
    file_.forgetError();
    if (!file_.append(waiting_)) return fail(file_.reason());
    bytes_ += static_cast<std::int64_t>(waiting_.size());
    waiting_.clear();
    error_.clear();
}

} // namespace physvib
