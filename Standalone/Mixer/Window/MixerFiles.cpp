// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes the mixer's settings folder.
#include "Mixer/Window/MixerFiles.h"
#include "Io/Disk/AtomicFile.h"
#include "Io/Disk/ContentHash.h"
#include "Io/Disk/ReadFile.h"
#include "Scene/SceneLimits.h"
#include <cstdlib>
#include <system_error>

namespace physvib {
namespace {

constexpr double keepMs = 2'000.0, longestKeepMs = 20'000.0, exposureMs = 5'000.0;

juce::PropertiesFile::Options options() {
    juce::PropertiesFile::Options o;
    o.storageFormat = juce::PropertiesFile::storeAsXML;
    o.millisecondsBeforeSaving = 500;
    return o;
}

constexpr std::size_t maxSettingsBytes = 1u << 18; // eight documents with the longest paths, fully escaped
constexpr std::ptrdiff_t maxSettingsTags = 1'000;  // a valid file has about thirty

/// Empty, or why the settings are not read. JUCE's XML reader recurses for nested tags, processes document
/// types, and blocks on pipes, so such files are rejected first.
std::string faultOfSettings(const juce::File& file) {
    const std::filesystem::path path = pathOf(file);
    if (const auto there = openRegular(path, maxSettingsBytes); !there) return there.error;
    const auto text = readFile(path, maxSettingsBytes);
    if (!text) return text.error;
    if (std::ranges::count(text.value, '<') > maxSettingsTags)
        return path.string() + ": expected at most " + std::to_string(maxSettingsTags) + " tags, found more";
    const bool isPlain = text.value.starts_with("<?xml") && text.value.find("<!") == std::string::npos;
    if (isPlain && juce::parseXMLIfTagMatches(utf8(text.value), "PROPERTIES")) return {};
    return path.string() +
           ": expected settings as the mixer writes them, found something else, or a part of them";
}

/// File for settings. An unreadable file is renamed and reported in `fault`.
juce::File readableSettings(const juce::File& file, std::string& fault) {
    if (file.exists()) fault = faultOfSettings(file);
    if (fault.empty()) return file;
    const juce::File aside = file.withFileExtension("settings.unread");
    std::error_code code;
    std::filesystem::rename(pathOf(file), pathOf(aside), code);
    fault += code ? "; settings are not kept"
                  : "; it is now " + aside.getFileName().toStdString() + ", and settings begin anew";
    return code ? juce::File{} : file;
}

juce::String today() { return juce::Time::getCurrentTime().formatted("%Y-%m-%d"); }

juce::String ownMark(std::string_view text, const std::string& output) {
    return utf8(contentHash(std::string{text} + '\n' + output));
}

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
std::optional<SystemFile> tryLock(const fs::path& copy) {
    SystemFile lock = SystemFile::look(lockOf(copy));
    if (lock.isOpen() && lock.lock() == Lock::others) return {};
    return lock;
}

} // namespace

juce::File mixerFolder() {
    const char* configured = std::getenv("XDG_CONFIG_HOME");
    const juce::File base = configured != nullptr && *configured == '/'
                                ? juce::File{configured}
                                : juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory);
    return base.getChildFile("physvib");
}

MixerFiles::MixerFiles(const juce::File& folder)
    : folder_{folder}
    , copies_{pathOf(folder)}
    , settings_{readableSettings(folder.getChildFile("mixer.settings"), fault_), options()} {
    folder_.createDirectory();
    // JUCE would parse these as XML
    for (const auto& key : juce::StringArray{settings_.getAllProperties().getAllKeys()})
        if (settings_.getValue(key).trimStart().startsWithChar('<')) settings_.removeValue(key);
    recent_.setMaxNumberOfItems(8);
    recent_.restoreFromString(settings_.getValue("recent"));
    recent_.removeNonExistentFiles();
}

MixerFiles::~MixerFiles() { settings_.saveIfNeeded(); }

void MixerFiles::addRecent(const juce::File& file) {
    recent_.addFile(file);
    settings_.setValue("recent", recent_.toString());
    settings_.saveIfNeeded();
}

DeskLimits MixerFiles::limits() const {
    return readDeskLimits(settings_.getValue(limitsSetting).toStdString())
        .value_or(DeskLimits::of(MixerModel::firstMix()));
}

void MixerFiles::addOwn(std::string_view text, const std::string& output) {
    constexpr int mostOwn = 64;
    auto marks = juce::StringArray::fromTokens(settings_.getValue(ownSetting), " ", {});
    marks.add(ownMark(text, output));
    marks.removeRange(0, marks.size() - mostOwn);
    settings_.setValue(ownSetting, marks.joinIntoString(" "));
}

bool MixerFiles::isOwn(const juce::File& file, const std::string& output) const {
    const auto text = readFile(pathOf(file), limits::maxSessionFileBytes);
    return text && juce::StringArray::fromTokens(settings_.getValue(ownSetting), " ", {})
                       .contains(ownMark(text.value, output));
}

double MixerFiles::exposureToday() const {
    const auto words = juce::StringArray::fromTokens(settings_.getValue(exposureSetting), " ", {});
    const double taken = words.size() == 2 && words[0] == today() ? words[1].getDoubleValue() : 0.0;
    return std::isfinite(taken) ? std::max(0.0, taken) : 0.0;
}

// Limits the rate of file writes, because the value grows steadily.
void MixerFiles::setExposureToday(double squareGSeconds, bool isLast) {
    const double now = nowMs();
    if (!isLast && now - exposureAtMs_ < exposureMs) return;
    exposureAtMs_ = now;
    settings_.setValue(exposureSetting, today() + " " + juce::String{squareGSeconds});
}

juce::Array<juce::File> MixerFiles::ownScenes() const {
    auto files = scenesFolder().findChildFiles(juce::File::findFiles, false, "*.json");
    files.sort();
    return files;
}

std::optional<std::string> MixerFiles::keep(MixerModel& model, bool isChanged) {
    if (!isChanged) return std::string{};
    const double now = nowMs(), passed = now - keptAtMs_;
    if (passed < (model.edits() != keptEdits_ ? keepMs : longestKeepMs)) return {};
    return keepNow(model);
}

std::string MixerFiles::keepNow(MixerModel& model) {
    keptAtMs_ = nowMs();
    keptEdits_ = model.edits();
    settings_.saveIfNeeded(); // limits first, so that the copy is never newer than the mixer's saved limits
    return copies_.keep(sessionJson(model.saved(), std::filesystem::path{pathOf(folder_)}));
}

// Recovery copies recovery-NAME.json, each with a lock file. The lock is separate, because the copy is
// replaced at each update.

RecoveryCopies::RecoveryCopies(const fs::path& folder)
    : folder_{folder}
    , own_{folder / (std::string{prefix} + juce::Uuid{}.toString().toStdString() + ".json")} {
    std::error_code code;
    for (fs::path copy : filesOf(folder, ".lock")) // of runs that ended before their first copy was there
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
        if (copy != own_ && std::ranges::find(before_, copy) == before_.end() && tryLock(copy))
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
    const auto held = tryLock(copy);
    if (!held) return copy.string() + ": cannot be removed: another mixer keeps it";
    { const AtomicFile sweep{copy}; } // removes the temporary file of an interrupted write
    std::error_code code;
    if (fs::remove(copy, code); code) return copy.string() + ": cannot be removed: " + code.message();
    fs::remove(lockOf(copy), code);
    return {};
}

} // namespace physvib
