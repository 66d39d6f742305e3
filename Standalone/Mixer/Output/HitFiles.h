// SPDX-License-Identifier: GPL-3.0-or-later
// Exports selected impacts to files, and keeps temporary files of drags for other programs.
#pragma once
#include "Formats/ClipFile.h"
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// File extensions for impacts: samples, or a clip format.
inline const juce::StringArray& hitEndings() {
    static const juce::StringArray all = [] {
        juce::StringArray endings{".wav"}; // what most programs take
        for (const auto ending : clipEndings) endings.add(ending.data());
        return endings;
    }();
    return all;
}

struct WrittenHits {
    std::vector<std::string> paths;  ///< one, or one per actuator if the format is mono
    std::vector<std::string> losses; ///< data that the format cannot store
};

/// Writes the impacts (in any order) from the first one on, panned over the actuators by the law of `mix`, in
/// the format of the extension of `path`; or one error line. Several files never replace existing ones.
/// Message thread only.
Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path);

/// Files dragged to other programs. Some of these copy them late, so they exist until the mixer ends. Message
/// thread only.
class DraggedFiles {
public:
    ~DraggedFiles() { folder_.deleteRecursively(); }

    /// Creates an empty folder for the files of one drag; or one error line.
    Result<juce::File> makeFolder();

    /// Selected format of drags, an index of hitEndings(); kept when another document is opened.
    int ending() const noexcept { return ending_; }
    void setEnding(int ending) noexcept { ending_ = ending; }

private:
    juce::File folder_;
    int drags_ = 0, ending_ = 0;
};

} // namespace physvib
