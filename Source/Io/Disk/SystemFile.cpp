// SPDX-License-Identifier: MIT
// Platform-independent part of SystemFile: ownership of the handle, error texts, and removal of temporary
// files when the program ends.
#include "Io/Disk/SystemFile.h"
#include "Io/Disk/FileClash.h"
#include <cerrno>
#include <memory>
#include <system_error>
#include <utility>

namespace physvib {

struct RemovedOnEnd::Removal {
    SystemFile::Handle handle;
    std::filesystem::path name;
};

std::array<std::atomic<RemovedOnEnd::Removal*>, 256> RemovedOnEnd::removals{};

SystemFile SystemFile::create(const std::filesystem::path& path) { return opened(path, Opening::create); }
SystemFile SystemFile::grow(const std::filesystem::path& path) {
    std::error_code code;
    if (!std::filesystem::is_symlink(path, code) || isWithin(path.parent_path(), path))
        return opened(path, Opening::grow);
    SystemFile refused;
    refused.error_ = ELOOP;
    return refused;
}
SystemFile SystemFile::look(const std::filesystem::path& path) { return opened(path, Opening::look); }

SystemFile::SystemFile(SystemFile&& other) noexcept
    : handle_{std::exchange(other.handle_, none)}
    , error_{std::exchange(other.error_, 0)} {}

SystemFile& SystemFile::operator=(SystemFile&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(error_, other.error_);
    return *this;
}

SystemFile::~SystemFile() {
    if (isOpen()) closeNow();
}

std::string SystemFile::reason() const {
    if (error_ == ELOOP) return leadsElsewhere;
    if (error_ == EINVAL) return "expected a regular file, found a folder, a device or a pipe";
    return error_ == 0 ? std::string{} : std::generic_category().message(error_);
}

void SystemFile::refuse() noexcept {
    closeNow();
    handle_ = none;
    error_ = EINVAL;
}

bool SystemFile::append(std::string_view bytes) noexcept {
    const std::int64_t end = size();
    if (error_ != 0 || writeAt(end, bytes)) return error_ == 0;
    const int first = std::exchange(error_, 0);
    resize(end);
    error_ = first; // the first error is the one that counts
    return false;
}

bool SystemFile::isAt(const std::filesystem::path& path) const noexcept { return isAt(handle_, path); }

std::string SystemFile::changeByOthers(const std::filesystem::path& path, std::int64_t bytes) {
    if (error_ != 0) return {}; // then its length is not known
    std::error_code gone;
    const auto place = std::filesystem::canonical(path, gone);
    if (gone || !isAt(place)) return "it was removed, moved or replaced while it was being written";
    if (size() != bytes) return "another program changed its length while it was being written";
    return {};
}

RemovedOnEnd::RemovedOnEnd(const SystemFile& file, const std::filesystem::path& name) {
    auto removal = std::make_unique<Removal>(Removal{file.handle_, std::filesystem::absolute(name)});
    for (std::size_t i = 0; i < removals.size() && slot_ < 0; ++i) {
        Removal* none = nullptr;
        if (removals[i].compare_exchange_strong(none, removal.get())) slot_ = static_cast<int>(i);
    }
    // the slot owns it; without one there are more files at once than any call writes
    if (slot_ >= 0) static_cast<void>(removal.release());
}

RemovedOnEnd::RemovedOnEnd(RemovedOnEnd&& other) noexcept
    : slot_{std::exchange(other.slot_, -1)} {}

RemovedOnEnd& RemovedOnEnd::operator=(RemovedOnEnd&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

RemovedOnEnd::~RemovedOnEnd() {
    if (slot_ >= 0) delete removals[static_cast<std::size_t>(slot_)].exchange(nullptr);
}

void RemovedOnEnd::removeAll() noexcept {
    for (auto& slot : removals)
        if (const Removal* const removal = slot.exchange(nullptr);
            removal && SystemFile::isAt(removal->handle, removal->name))
            SystemFile::removeNow(removal->name);
}

} // namespace physvib
