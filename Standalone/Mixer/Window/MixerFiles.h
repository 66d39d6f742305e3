// SPDX-License-Identifier: GPL-3.0-or-later
// What the mixer keeps between its runs: settings, recent documents, and a copy of the session in case it
// ends badly.
#pragma once
#include "Live/Documents/DeskLimits.h"
#include "Mixer/Desk/Desk.h"
#include "Mixer/Window/RecoveryCopies.h"
#include <juce_gui_extra/juce_gui_extra.h>

namespace physvib {

/// $XDG_CONFIG_HOME/physvib, or ~/.config/physvib.
juce::File mixerFolder();

/// M only.
class MixerFiles {
public:
    explicit MixerFiles(const juce::File& folder = mixerFolder());
    ~MixerFiles();

    juce::PropertiesFile& settings() noexcept { return settings_; }
    const std::string& settingsFault() const noexcept { return fault_; } ///< empty, or why they begin anew
    juce::RecentlyOpenedFilesList& recent() noexcept { return recent_; }
    void addRecent(const juce::File& file);

    /// What files may ask of the desk when there is none yet: as it was left, else nothing above firstMix().
    /// Kept between runs.
    DeskLimits limits() const;
    void setLimits(const DeskLimits& limits) {
        settings_.setValue(limitsSetting, juce::String::fromUTF8(deskLimitsText(limits).c_str()));
    }

    /// What hands have taken of this mixer today, in g^2 s, weighted; kept between runs, however they end.
    double exposureToday() const;
    void setExposureToday(double squareGSeconds, bool isLast = false); ///< written now and then, and at last

    /// where scenes of one's own are looked for
    juce::File scenesFolder() const { return folder_.getChildFile("scenes"); }
    juce::Array<juce::File> ownScenes() const;

    RecoveryCopies& copies() noexcept { return copies_; }
    /// Writes the copy of this run if there is something new, as often as it is worth. Empty, or why it
    /// cannot be written.
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
