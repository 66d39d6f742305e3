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
    waiting_.clear();
    error_.clear();
}

} // namespace physvib
