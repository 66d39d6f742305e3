// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes the mixer's settings folder.
#include "Mixer/Window/MixerFiles.h"
#include "Io/Disk/ReadFile.h"
#include "Mixer/Desk/DeskWords.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace physvib {

namespace {

constexpr double keepMs = 2'000.0, longestKeepMs = 20'000.0, exposureMs = 5'000.0;

juce::PropertiesFile::Options options() {
    juce::PropertiesFile::Options o;
    o.storageFormat = juce::PropertiesFile::storeAsXML;
    o.millisecondsBeforeSaving = 500;
    return o;
}

constexpr std::size_t mostSettingsBytes = 1u << 18; // enough for eight recent documents with the longest
                                                    // paths, fully escaped
constexpr std::ptrdiff_t mostSettingsTags = 1'000;  // a valid file has about thirty

/// Empty, or why the settings are not read. JUCE's XML reader recurses for nested tags, processes document
/// types, and blocks on pipes, so such files are rejected first.
std::string faultOfSettings(const juce::File& file) {
    const std::filesystem::path path = file.getFullPathName().toStdString();
    if (const auto there = openRegular(path, mostSettingsBytes); !there) return there.error;
    const auto text = readFile(path, mostSettingsBytes);
    if (!text) return text.error;
    if (std::ranges::count(text.value, '<') > mostSettingsTags)
        return path.string() + ": expected at most " + std::to_string(mostSettingsTags) + " tags, found more";
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
    std::filesystem::rename(file.getFullPathName().toStdString(), aside.getFullPathName().toStdString(),
                            code);
    fault += code ? "; settings are not kept"
                  : "; it is now " + aside.getFileName().toStdString() + ", and settings begin anew";
    return code ? juce::File{} : file;
}

juce::String today() { return juce::Time::getCurrentTime().formatted("%Y-%m-%d"); }

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
    , copies_{folder.getFullPathName().toStdString()}
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
        .value_or(DeskLimits::of(Desk::firstMix()));
}

double MixerFiles::exposureToday() const {
    const auto words = juce::StringArray::fromTokens(settings_.getValue(exposureSetting), " ", {});
    const double taken = words.size() == 2 && words[0] == today() ? words[1].getDoubleValue() : 0.0;
    return std::isfinite(taken) ? std::max(0.0, taken) : 0.0;
}

// Limits the rate of file writes, because the value grows steadily.
void MixerFiles::setExposureToday(double squareGSeconds, bool isLast) {
    const double now = juce::Time::getMillisecondCounterHiRes();
    if (!isLast && now - exposureAtMs_ < exposureMs) return;
    exposureAtMs_ = now;
    settings_.setValue(exposureSetting, today() + " " + juce::String{squareGSeconds});
}

juce::Array<juce::File> MixerFiles::ownScenes() const {
    auto files = scenesFolder().findChildFiles(juce::File::findFiles, false, "*.json");
    files.sort();
    return files;
}

std::string MixerFiles::keep(Desk& desk, bool isChanged) {
    const double now = juce::Time::getMillisecondCounterHiRes(), passed = now - keptAtMs_;
    if (!isChanged || passed < (desk.edits() != keptEdits_ ? keepMs : longestKeepMs)) return {};
    return keepNow(desk);
}

std::string MixerFiles::keepNow(Desk& desk) {
    keptAtMs_ = juce::Time::getMillisecondCounterHiRes();
    keptEdits_ = desk.edits();
    settings_.saveIfNeeded(); // limits first, so that the copy is never newer than the mixer's saved limits
    return copies_.keep(
        sessionJson(desk.saved(), std::filesystem::path{folder_.getFullPathName().toStdString()}));
}

} // namespace physvib
