// SPDX-License-Identifier: GPL-3.0-or-later
// Letters of other scripts: JUCE draws boxes for those that its typeface lacks, so another typeface is used
// while they are shown.
#pragma once
#include "Mixer/Studies/StudyFont.h"
#include <memory>

namespace physvib {

/// The typeface that has all letters that have been shown, if one is installed. M only.
class ShownLetters {
public:
    /// True: the typeface is another one now, and all is to be drawn again. Costs little where there is no
    /// new letter.
    bool show(const juce::String& words);

private:
    juce::String letters_; // beyond ASCII, each once
    std::unique_ptr<StudyFont> font_;
};

} // namespace physvib
