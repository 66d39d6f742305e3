// SPDX-License-Identifier: GPL-3.0-or-later
// Files in one folder; a copy bears the number of its process.
#include "Mixer/Window/MixerFiles.h"
#include "System/Process.h"
#include "Io/Disk/AtomicFile.h"
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>

namespace physvib {

namespace {

constexpr const char* copyPrefix = "recovery-";
constexpr double keepMs = 2'000.0, longestKeepMs = 20'000.0, exposureMs = 5'000.0;

juce::PropertiesFile::Options options() {
    juce::PropertiesFile::Options o;
    o.storageFormat = juce::PropertiesFile::storeAsXML;
    o.millisecondsBeforeSaving = 500;
    return o;
}

juce::String today() { return juce::Time::getCurrentTime().formatted("%Y-%m-%d"); }

} // namespace

juce::File mixerFolder() {
    const char* configured = std::getenv("XDG_CONFIG_HOME");
    const juce::File base = configured != nullptr && *configured == '/' ? juce::File{configured} : juce::File::getSpecialLocation(juce::File::userApplicationDataDirectory);
    return base.getChildFile("physvib");
}

MixerFiles::MixerFiles(const juce::File& folder)
    : folder_{folder}
    , copy_{folder.getChildFile(copyPrefix + juce::String{processNumber()} + ".json")}
    , settings_{folder.getChildFile("mixer.settings"), options()} {
    folder_.createDirectory();
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

DeskLimits MixerFiles::limits() const { return readDeskLimits(settings_.getValue(limitsSetting).toStdString()).value_or(DeskLimits::of(Desk::firstMix())); }

double MixerFiles::exposureToday() const {
    const auto words = juce::StringArray::fromTokens(settings_.getValue(exposureSetting), " ", {});
    const double taken = words.size() == 2 && words[0] == today() ? words[1].getDoubleValue() : 0.0;
    return std::isfinite(taken) ? std::max(0.0, taken) : 0.0;
}

// Now and then: it grows all the time, and each time is a file.
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

std::vector<juce::File> MixerFiles::leftBehind() const {
    std::vector<juce::File> found;
    for (const auto& file : folder_.findChildFiles(juce::File::findFiles, false, juce::String{copyPrefix} + "*.json"))
        if (!isProcessRunning(file.getFileNameWithoutExtension().fromFirstOccurrenceOf(copyPrefix, false, false).getIntValue())) found.push_back(file);
    std::ranges::sort(found, std::greater{}, [](const juce::File& f) { return f.getLastModificationTime().toMilliseconds(); });
    return found;
}

std::string MixerFiles::keep(Desk& desk, bool isChanged) {
    const double now = juce::Time::getMillisecondCounterHiRes(), passed = now - keptAtMs_;
    if (!isChanged || passed < (desk.edits() != keptEdits_ ? keepMs : longestKeepMs)) return {};
    keptAtMs_ = now;
    keptEdits_ = desk.edits();
    settings_.saveIfNeeded(); // levels first: the copy must not be newer than what the desk allowed
    return writeFile(copy_.getFullPathName().toStdString(), sessionJson(desk.saved(), std::filesystem::path{folder_.getFullPathName().toStdString()}));
}

void MixerFiles::forget() { copy_.deleteFile(); }

} // namespace physvib
