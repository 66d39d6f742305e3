// SPDX-License-Identifier: GPL-3.0-or-later
// Recovery copies recovery-NAME.json, each with a lock file. The lock is separate, because the copy is
// replaced at each update.
#include "Mixer/Window/RecoveryCopies.h"
#include "Io/Disk/AtomicFile.h"
#include <algorithm>
#include <juce_core/juce_core.h>
#include <optional>
#include <system_error>
#include <utility>

namespace physvib {
namespace {

namespace fs = std::filesystem;
using Lock = SystemFile::Lock;

constexpr std::string_view prefix = "recovery-";

fs::path lockOf(fs::path copy) { return copy.replace_extension(".lock"); }

std::vector<fs::path> filesOf(const fs::path& folder, std::string_view ending) {
    std::vector<fs::path> found;
    std::error_code code;
    for (fs::directory_iterator entry{folder, code}, end; !code && entry != end; entry.increment(code))
        if (entry->path().filename().string().starts_with(prefix) && entry->path().extension() == ending)
            found.push_back(entry->path());
    return found;
}

/// Acquires the lock of a copy whose run has ended; a copy without a lock file gives a closed file. nullopt
/// if its run still holds the lock.
std::optional<SystemFile> takeLock(const fs::path& copy) {
    SystemFile lock = SystemFile::look(lockOf(copy));
    if (lock.isOpen() && lock.lock() == Lock::others) return {};
    return lock;
}

} // namespace

RecoveryCopies::RecoveryCopies(const fs::path& folder)
    : folder_{folder}
    , own_{folder / (std::string{prefix} + juce::Uuid{}.toString().toStdString() + ".json")} {
    std::error_code code;
    for (fs::path copy : filesOf(folder, ".lock")) // lock files of runs that ended before their first copy
                                                   // was complete
        if (!fs::exists(fs::symlink_status(copy.replace_extension(".json"), code))) remove(copy);
}

RecoveryCopies::~RecoveryCopies() {
    std::error_code code;
    if (lock_.isOpen() && !fs::exists(own_, code)) fs::remove(lockOf(own_), code);
}

std::vector<fs::path> RecoveryCopies::leftBehind() const {
    std::vector<std::pair<fs::file_time_type, fs::path>> found;
    std::error_code code; // deleted files get the oldest time
    for (const fs::path& copy : filesOf(folder_, ".json"))
        if (copy != own_ && std::ranges::find(before_, copy) == before_.end() && takeLock(copy))
            found.emplace_back(fs::last_write_time(copy, code), copy);
    std::ranges::sort(found, std::greater{});
    std::vector<fs::path> copies;
    for (auto& [time, copy] : found) copies.push_back(std::move(copy));
    return copies;
}

// Without blocking on a pipe.
Result<SavedSession> RecoveryCopies::read(const fs::path& copy) {
    if (const SystemFile there = SystemFile::look(copy); !there.isOpen())
        return Failure{copy.string() + ": cannot be read: " + there.reason()};
    return loadSession(copy);
}

std::string RecoveryCopies::keep(std::string_view session) {
    lock();
    std::string error = writeFile(own_, session);
    if (error.empty()) std::erase_if(before_, [](const fs::path& copy) { return remove(copy).empty(); });
    return error;
}

void RecoveryCopies::forget() {
    std::error_code code;
    fs::remove(own_, code);
    for (const fs::path& copy : std::exchange(before_, {})) remove(copy);
}

// Another mixer may mistake the new lock file for an abandoned one before it is locked, so this retries.
// Without a lock the copy is still written, but other mixers offer it during this run.
void RecoveryCopies::lock() {
    const fs::path path = lockOf(own_);
    for (int tries = 0; tries < 100 && !lock_.isOpen(); ++tries) {
        SystemFile made = SystemFile::grow(path);
        if (!made.isOpen()) return;
        if (made.lock() != Lock::others && made.isAt(path)) lock_ = std::move(made);
    }
}

std::string RecoveryCopies::remove(const fs::path& copy) {
    const auto held = takeLock(copy);
    if (!held) return copy.string() + ": cannot be removed: another mixer keeps it";
    { const AtomicFile sweep{copy}; } // removes the temporary file of an interrupted write
    std::error_code code;
    if (fs::remove(copy, code); code) return copy.string() + ": cannot be removed: " + code.message();
    fs::remove(lockOf(copy), code);
    return {};
}

} // namespace physvib
