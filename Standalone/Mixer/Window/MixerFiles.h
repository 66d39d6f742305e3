// SPDX-License-Identifier: GPL-3.0-or-later
// Files that the mixer keeps between runs: settings, recent documents, and recovery copies of the session.
#pragma once
#include "Live/Documents/Mix.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/RecoveryCopies.h"
#include <juce_gui_extra/juce_gui_extra.h>

namespace physvib {

/// $XDG_CONFIG_HOME/physvib, or ~/.config/physvib.
juce::File mixerFolder();

/// Message thread only.
class MixerFiles {
public:
    explicit MixerFiles(const juce::File& folder = mixerFolder());
    ~MixerFiles();

    juce::PropertiesFile& settings() noexcept { return settings_; }
    const std::string& settingsFault() const noexcept { return fault_; } ///< why they were reset
    juce::RecentlyOpenedFilesList& recent() noexcept { return recent_; }
    void addRecent(const juce::File& file);

    /// Level limits for opened files if there is no mixer state yet: those of the last run, else of
    /// firstMix(). Stored between runs.
    DeskLimits limits() const;
    void setLimits(const DeskLimits& limits) {
        settings_.setValue(limitsSetting, juce::String::fromUTF8(deskLimitsText(limits).c_str()));
    }

    /// Vibration exposure from this mixer today, in g^2 s, weighted. Stored between runs, even after a crash.
    double exposureToday() const;
    void setExposureToday(double squareGSeconds, bool isLast = false); ///< written at intervals, and at the
                                                                       ///< end

    /// Folder of the user's scenes.
    juce::File scenesFolder() const { return folder_.getChildFile("scenes"); }
    juce::Array<juce::File> ownScenes() const;

    RecoveryCopies& copies() noexcept { return copies_; }
    /// Writes this run's recovery copy if there are changes, at a limited rate. Empty, or why it cannot be
    /// written.
    std::string keep(Desk& desk, bool isChanged);
    std::string keepNow(Desk& desk);

private:
    static constexpr const char *limitsSetting = "desk", *exposureSetting = "exposure";

    juce::File folder_;
    RecoveryCopies copies_;
    std::string fault_;
    juce::PropertiesFile settings_;
    juce::RecentlyOpenedFilesList recent_;
    std::uint64_t keptEdits_ = 0;
    double keptAtMs_ = 0.0, exposureAtMs_ = 0.0;
};

} // namespace physvib
