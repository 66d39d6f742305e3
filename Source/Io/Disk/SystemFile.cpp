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

struct RemoveOnSignal::Removal {
    SystemFile::Handle handle;
    std::filesystem::path name;
};

std::array<std::atomic<RemoveOnSignal::Removal*>, 256> RemoveOnSignal::removals{};

SystemFile SystemFile::create(const std::filesystem::path& path) { return openWith(path, Opening::create); }
SystemFile SystemFile::openForAppending(const std::filesystem::path& path) {
    std::error_code code;
    if (!std::filesystem::is_symlink(path, code) || isWithin(path.parent_path(), path))
        return openWith(path, Opening::append);
    SystemFile refused;
    refused.error_ = ELOOP;
    return refused;
}
SystemFile SystemFile::openForLocking(const std::filesystem::path& path) {
    return openWith(path, Opening::lockOnly);
}

SystemFile::SystemFile(SystemFile&& other) noexcept
    : handle_{std::exchange(other.handle_, noHandle)}
    , error_{std::exchange(other.error_, 0)} {}

SystemFile& SystemFile::operator=(SystemFile&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(error_, other.error_);
    return *this;
}

SystemFile::~SystemFile() {
    if (isOpen()) closeHandle();
}

std::string SystemFile::reason() const {
    if (error_ == ELOOP) return linkLeadsElsewhere;
    if (error_ == EINVAL) return "expected a regular file, found a folder, a device or a pipe";
    return error_ == 0 ? std::string{} : std::generic_category().message(error_);
}

void SystemFile::closeAsIrregular() noexcept {
    closeHandle();
    handle_ = noHandle;
    error_ = EINVAL;
}

bool SystemFile::append(std::string_view bytes) noexcept {
    const std::int64_t end = size();
    if (error_ != 0 || writeAt(end, bytes)) return error_ == 0;
    const int firstError = std::exchange(error_, 0);
    resize(end);
    error_ = firstError; // the first error is the one that counts
    return false;
}

bool SystemFile::isAt(const std::filesystem::path& path) const noexcept { return isAt(handle_, path); }

std::string SystemFile::externalChange(const std::filesystem::path& path, std::int64_t bytes) {
    if (error_ != 0) return {}; // size() is not known after an error
    std::error_code code;
    const auto canonicalPath = std::filesystem::canonical(path, code);
    if (code || !isAt(canonicalPath)) return "it was removed, moved or replaced while it was being written";
    if (size() != bytes) return "another program changed its length while it was being written";
    return {};
}

RemoveOnSignal::RemoveOnSignal(const SystemFile& file, const std::filesystem::path& name) {
    auto removal = std::make_unique<Removal>(Removal{file.handle_, std::filesystem::absolute(name)});
    for (std::size_t i = 0; i < removals.size() && slot_ < 0; ++i) {
        Removal* emptySlot = nullptr;
        if (removals[i].compare_exchange_strong(emptySlot, removal.get())) slot_ = static_cast<int>(i);
    }
    // the slot owns it now; no program writes more files at once than there are slots
    if (slot_ >= 0) static_cast<void>(removal.release());
}

RemoveOnSignal& RemoveOnSignal::operator=(RemoveOnSignal&& other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
}

RemoveOnSignal::~RemoveOnSignal() {
    if (slot_ >= 0) delete removals[static_cast<std::size_t>(slot_)].exchange(nullptr);
}

void RemoveOnSignal::removeAll() noexcept {
    for (auto& slot : removals)
        if (const Removal* const removal = slot.exchange(nullptr);
            removal && SystemFile::isAt(removal->handle, removal->name))
            SystemFile::removePath(removal->name);
}

} // namespace physvib
