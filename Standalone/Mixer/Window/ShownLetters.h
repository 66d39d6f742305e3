// SPDX-License-Identifier: GPL-3.0-or-later
// Selects a typeface for letters of other scripts, because JUCE draws boxes for letters that its typeface
// lacks.
#pragma once
#include "Mixer/Studies/StudyFont.h"
#include <memory>

namespace physvib {

/// Uses an installed typeface with all displayed letters, if there is one. Message thread only.
class ShownLetters {
public:
    /// True if the typeface changed, so that everything must be redrawn. Cheap if there is no new letter.
    bool show(const juce::String& words);

private:
    juce::String letters_; // non-ASCII letters, each once
    std::unique_ptr<StudyFont> font_;
};

} // namespace physvib
