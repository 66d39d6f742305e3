// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes settings, recent documents and recovery copies in the mixer's settings folder.
#include "Mixer/Window/MixerFiles.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneLimits.h"
#include <cstdlib>
#include <system_error>

namespace physvib {
namespace {

constexpr double copyIntervalMs = 2'000.0, maxCopyIntervalMs = 20'000.0, exposureIntervalMs = 5'000.0;

juce::PropertiesFile::Options options() {
    juce::PropertiesFile::Options options;
    options.storageFormat = juce::PropertiesFile::storeAsXML;
    options.millisecondsBeforeSaving = 500;
    return options;
}

constexpr std::size_t maxSettingsBytes = 1u << 18; // eight documents with the longest paths, fully escaped
constexpr std::ptrdiff_t maxSettingsTags = 1'000;  // a valid file has about thirty

/// Empty, or why the settings are not read. JUCE's XML reader recurses for nested tags, processes document
/// types, and blocks on pipes, so such files are rejected first.
std::string checkSettings(const juce::File& file) {
    const std::filesystem::path path = pathOf(file);
    if (const auto opened = openRegularFile(path, maxSettingsBytes); !opened) return opened.error;
    const auto text = readFile(path, maxSettingsBytes);
    if (!text) return text.error;
    if (std::ranges::count(text.value, '<') > maxSettingsTags)
        return path.string() + ": expected at most " + std::to_string(maxSettingsTags) + " tags, found more";
    const bool isPlain = text.value.starts_with("<?xml") && text.value.find("<!") == std::string::npos;
    if (isPlain && juce::parseXMLIfTagMatches(utf8(text.value), "PROPERTIES")) return {};
    return path.string() +
           ": expected settings as the mixer writes them, found something else, or a part of them";
}

/// File for settings. An unreadable file is renamed and reported in `error`.
juce::File readableSettings(const juce::File& file, std::string& error) {
    if (file.exists()) error = checkSettings(file);
    if (error.empty()) return file;
    const juce::File unreadFile = file.withFileExtension("settings.unread");
    std::error_code code;
    std::filesystem::rename(pathOf(file), pathOf(unreadFile), code);
    error += code ? "; settings are not kept"
                  : "; it is now " + unreadFile.getFileName().toStdString() + ", and settings begin anew";
    return code ? juce::File{} : file;
}

juce::String today() { return juce::Time::getCurrentTime().formatted("%Y-%m-%d"); }

juce::String sessionHash(std::string_view text, const std::string& output) {
    return utf8(contentHash(std::string{text} + '\n' + output));
}

namespace fs = std::filesystem;
using Lock = SystemFile::Lock;

constexpr std::string_view copyPrefix = "recovery-";

fs::path lockPath(fs::path copy) { return copy.replace_extension(".lock"); }

std::vector<fs::path> listFiles(const fs::path& folder, std::string_view ending) {
    std::vector<fs::path> found;
    std::error_code code;
    for (fs::directory_iterator entry{folder, code}, end; !code && entry != end; entry.increment(code))
        if (entry->path().filename().string().starts_with(copyPrefix) && entry->path().extension() == ending)
            found.push_back(entry->path());
    return found;
}

/// Acquires the lock of a copy whose run has ended; a copy without a lock file gives a closed file. nullopt
/// if its run still holds the lock.
std::optional<SystemFile> tryLock(const fs::path& copy) {
    SystemFile lock = SystemFile::openForLocking(lockPath(copy));
    if (lock.isOpen() && lock.lock() == Lock::heldByOthers) return {};
    return lock;
}

} // namespace

juce::File mixerFolder() {
    const char* configFolder = std::getenv("XDG_CONFIG_HOME");
    const juce::File base = configFolder != nullptr && *configFolder == '/'
                                ? juce::File{configFolder}
                                : juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory);
    return base.getChildFile("physvib");
}

MixerFiles::MixerFiles(const juce::File& folder)
    : folder_{folder}
    , copies_{pathOf(folder)}
    , settings_{readableSettings(folder.getChildFile("mixer.settings"), settingsError_), options()} {
    folder_.createDirectory();
    // JUCE would parse such values as XML
    for (const auto& key : juce::StringArray{settings_.getAllProperties().getAllKeys()})
        if (settings_.getValue(key).trimStart().startsWithChar('<')) settings_.removeValue(key);
    recentFiles_.setMaxNumberOfItems(8);
    recentFiles_.restoreFromString(settings_.getValue("recent"));
    recentFiles_.removeNonExistentFiles();
}

MixerFiles::~MixerFiles() { settings_.saveIfNeeded(); }

void MixerFiles::addRecent(const juce::File& file) {
    recentFiles_.addFile(file);
    settings_.setValue("recent", recentFiles_.toString());
    settings_.saveIfNeeded();
}

MixerLimits MixerFiles::limits() const {
    return readMixerLimits(settings_.getValue(limitsSetting).toStdString())
        .value_or(MixerLimits::fromMix(MixerModel::defaultMix()));
}

void MixerFiles::addOwnSession(std::string_view text, const std::string& output) {
    constexpr int maxHashes = 64;
    auto hashes = juce::StringArray::fromTokens(settings_.getValue(ownSetting), " ", {});
    hashes.add(sessionHash(text, output));
    hashes.removeRange(0, hashes.size() - maxHashes);
    settings_.setValue(ownSetting, hashes.joinIntoString(" "));
}

bool MixerFiles::isOwnSession(const juce::File& file, const std::string& output) const {
    const auto text = readFile(pathOf(file), limits::maxSessionFileBytes);
    return text && juce::StringArray::fromTokens(settings_.getValue(ownSetting), " ", {})
                       .contains(sessionHash(text.value, output));
}

double MixerFiles::exposureToday() const {
    const auto parts = juce::StringArray::fromTokens(settings_.getValue(exposureSetting), " ", {});
    const double exposure = parts.size() == 2 && parts[0] == today() ? parts[1].getDoubleValue() : 0.0;
    return std::isfinite(exposure) ? std::max(0.0, exposure) : 0.0;
}

// Limits the rate of file writes, because the value grows steadily.
void MixerFiles::setExposureToday(double squareGSeconds, bool isLast) {
    const double now = nowMs();
    if (!isLast && now - exposureAtMs_ < exposureIntervalMs) return;
    exposureAtMs_ = now;
    settings_.setValue(exposureSetting, today() + " " + juce::String{squareGSeconds});
}

juce::Array<juce::File> MixerFiles::ownScenes() const {
    auto files = scenesFolder().findChildFiles(juce::File::findFiles, false, "*.json");
    files.sort();
    return files;
}

std::optional<std::string> MixerFiles::writeCopyIfDue(MixerModel& model, bool hasUnsavedChanges) {
    if (!hasUnsavedChanges) return std::string{};
    const double now = nowMs(), passedMs = now - copiedAtMs_;
    if (passedMs < (model.editCount() != copiedEditCount_ ? copyIntervalMs : maxCopyIntervalMs)) return {};
    return writeCopyNow(model);
}

std::string MixerFiles::writeCopyNow(MixerModel& model) {
    copiedAtMs_ = nowMs();
    copiedEditCount_ = model.editCount();
    settings_.saveIfNeeded(); // limits first, so that the copy is never newer than the mixer's saved limits
    return copies_.write(sessionJson(model.savedSession(), std::filesystem::path{pathOf(folder_)}));
}

// Recovery copies recovery-NAME.json, each with a lock file. The lock is separate, because the copy is
// replaced at each update.

RecoveryCopies::RecoveryCopies(const fs::path& folder)
    : folder_{folder}
    , ownCopy_{folder / (std::string{copyPrefix} + juce::Uuid{}.toString().toStdString() + ".json")} {
    std::error_code code;
    for (fs::path copy : listFiles(folder, ".lock")) // locks of runs that ended before their first copy
        if (!fs::exists(fs::symlink_status(copy.replace_extension(".json"), code))) remove(copy);
}

RecoveryCopies::~RecoveryCopies() {
    std::error_code code;
    if (lock_.isOpen() && !fs::exists(ownCopy_, code)) fs::remove(lockPath(ownCopy_), code);
}

std::vector<fs::path> RecoveryCopies::abandonedCopies() const {
    std::vector<std::pair<fs::file_time_type, fs::path>> datedCopies;
    std::error_code code; // deleted files get the oldest time
    for (const fs::path& copy : listFiles(folder_, ".json"))
        if (copy != ownCopy_ && std::ranges::find(adopted_, copy) == adopted_.end() && tryLock(copy))
            datedCopies.emplace_back(fs::last_write_time(copy, code), copy);
    std::ranges::sort(datedCopies, std::greater{});
    std::vector<fs::path> copies;
    for (auto& [time, copy] : datedCopies) copies.push_back(std::move(copy));
    return copies;
}

// Opens the file first without blocking, since it may be a pipe.
Result<SavedSession> RecoveryCopies::read(const fs::path& copy) {
    if (const SystemFile opened = SystemFile::openForLocking(copy); !opened.isOpen())
        return Failure{copy.string() + ": cannot be read: " + opened.reason()};
    return loadSession(copy);
}

std::string RecoveryCopies::write(std::string_view session) {
    lock();
    std::string error = writeFile(ownCopy_, session);
    if (error.empty()) std::erase_if(adopted_, [](const fs::path& copy) { return remove(copy).empty(); });
    return error;
}

void RecoveryCopies::discardOwn() {
    std::error_code code;
    fs::remove(ownCopy_, code);
    for (const fs::path& copy : std::exchange(adopted_, {})) remove(copy);
}

// Another mixer may mistake the new lock file for an abandoned one before it is locked, so this retries.
// Without a lock the copy is still written, but other mixers offer it during this run.
void RecoveryCopies::lock() {
    const fs::path path = lockPath(ownCopy_);
    for (int attempts = 0; attempts < 100 && !lock_.isOpen(); ++attempts) {
        SystemFile lockFile = SystemFile::openForAppending(path);
        if (!lockFile.isOpen()) return;
        if (lockFile.lock() != Lock::heldByOthers && lockFile.isAt(path)) lock_ = std::move(lockFile);
    }
}

std::string RecoveryCopies::remove(const fs::path& copy) {
    const auto heldLock = tryLock(copy);
    if (!heldLock) return copy.string() + ": cannot be removed: another mixer keeps it";
    { const AtomicFile abandonedWrite{copy}; } // removes the temporary file of an interrupted write
    std::error_code code;
    if (fs::remove(copy, code); code) return copy.string() + ": cannot be removed: " + code.message();
    fs::remove(lockPath(copy), code);
    return {};
}

} // namespace physvib
