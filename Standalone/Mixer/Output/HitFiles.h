// SPDX-License-Identifier: GPL-3.0-or-later
// Chosen hits as files: what other programs take, and where it lies while they take it.
#pragma once
#include "Formats/ClipFile.h"
#include "Io/Result.h"
#include "Live/Documents/Mix.h"
#include <juce_core/juce_core.h>
#include <string>
#include <vector>

namespace physvib {

/// What hits can be written as: samples, or a clip.
inline const juce::StringArray& hitEndings() {
    static const juce::StringArray all = [] {
        juce::StringArray endings{".wav"}; // decision 94: what most programs take
        for (const auto ending : clipEndings) endings.add(ending.data());
        return endings;
    }();
    return all;
}

struct WrittenHits {
    std::vector<std::string> paths;  ///< one, or one for each enchanter of a format with one channel
    std::vector<std::string> losses; ///< what the format does not carry
};

/// The hits (in any order), from the first of them on, as enchanters and law of `mix` spread them, by what
/// `path` ends in; or one line. Several files replace none. M only.
Result<WrittenHits> writeHits(std::vector<CollisionEvent> hits, const Mix& mix, int sampleRateHz,
                              const juce::File& path);

/// Files that were dragged out, of which some programs make their copies late: they are there until the mixer
/// ends. M only.
class DraggedFiles {
public:
    ~DraggedFiles() { folder_.deleteRecursively(); }

    /// An empty one for the files of one drag; one line if there is no room for it.
    Result<juce::File> makeFolder();

    /// How hits are dragged, of hitEndings(); kept from one document to the next.
    int ending() const noexcept { return ending_; }
    void setEnding(int ending) noexcept { ending_ = ending; }

private:
    juce::File folder_;
    int drags_ = 0, ending_ = 0;
};

} // namespace physvib
