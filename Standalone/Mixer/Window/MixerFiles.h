// SPDX-License-Identifier: GPL-3.0-or-later
// Files that the mixer keeps between runs: settings, recent documents and recovery copies of sessions.
#pragma once
#include "Io/Disk/SystemFile.h"
#include "Mixer/Model/MixerModel.h"
#include <filesystem>
#include <juce_gui_extra/juce_gui_extra.h>
#include <string_view>

namespace physvib {

/// Recovery copies of sessions in one folder. Each run holds a lock on its copy, which the system releases
/// when the run ends in any way. A copy is removed only when its replacement is on disk or the user discards
/// it. Message thread.
class RecoveryCopies {
public:
    explicit RecoveryCopies(const std::filesystem::path& folder);
    ~RecoveryCopies();

    /// Copies of ended runs, newest first; they may be unreadable.
    std::vector<std::filesystem::path> abandonedCopies() const;

    /// The session of a copy, or one line that names the copy and the error.
    static Result<SavedSession> read(const std::filesystem::path& copy);

    /// Writes this run's copy to disk, then removes those that it replaces. Empty, or why it cannot be
    /// written.
    std::string write(std::string_view session);
    /// Takes over that copy: the next write() replaces it.
    void adopt(const std::filesystem::path& copy) { adopted_.push_back(copy); }
    /// Removes this run's copy and those that it replaces, after the session was saved or discarded.
    void discardOwn();

    /// Discards a copy on the user's request. Empty, or why it still exists.
    static std::string remove(const std::filesystem::path& copy);

private:
    void lock();

    std::filesystem::path folder_, ownCopy_;
    std::vector<std::filesystem::path> adopted_;
    SystemFile lock_;
};

/// The default settings folder: $XDG_CONFIG_HOME/physvib, or ~/.config/physvib.
juce::File mixerFolder();

/// The settings folder of the mixer. Message thread.
class MixerFiles {
public:
    explicit MixerFiles(const juce::File& folder = mixerFolder());
    ~MixerFiles();

    juce::PropertiesFile& settings() noexcept { return settings_; }
    const std::string& settingsError() const noexcept { return settingsError_; } ///< why they were reset
    juce::RecentlyOpenedFilesList& recentFiles() noexcept { return recentFiles_; }
    void addRecent(const juce::File& file);

    /// Level limits for opened files if there is no mixer state yet: those of the last run, else of
    /// defaultMix(). Stored between runs.
    MixerLimits limits() const;
    void setLimits(const MixerLimits& limits) {
        settings_.setValue(limitsSetting, juce::String::fromUTF8(mixerLimitsText(limits).c_str()));
    }

    /// Stores that the session `text` was saved while `output` was in use: its levels are the user's own.
    void addOwnSession(std::string_view text, const std::string& output);
    /// Whether the file is as it was saved by addOwnSession(), for that output.
    bool isOwnSession(const juce::File& file, const std::string& output) const;

    /// Vibration exposure from this mixer today, in g^2 s, weighted. Stored between runs, even after a crash.
    double exposureToday() const;
    void setExposureToday(double squareGSeconds, bool isLast = false); ///< rate-limited unless `isLast`

    juce::File scenesFolder() const { return folder_.getChildFile("scenes"); } ///< for the user's scenes
    juce::Array<juce::File> ownScenes() const;                                 ///< its files, sorted by name

    RecoveryCopies& copies() noexcept { return copies_; }
    /// Writes this run's recovery copy if there are changes, at a limited rate. Empty, or why it cannot be
    /// written.
    std::optional<std::string> writeCopyIfDue(MixerModel& model, bool hasUnsavedChanges);
    std::string writeCopyNow(MixerModel& model);

private:
    static constexpr const char *limitsSetting = "desk", *exposureSetting = "exposure",
                                *ownSetting = "own-sessions";

    juce::File folder_;
    RecoveryCopies copies_;
    std::string settingsError_;
    juce::PropertiesFile settings_;
    juce::RecentlyOpenedFilesList recentFiles_;
    std::uint64_t copiedEditCount_ = 0;
    double copiedAtMs_ = 0.0, exposureAtMs_ = 0.0;
};

} // namespace physvib
