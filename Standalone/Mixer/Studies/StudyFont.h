// SPDX-License-Identifier: GPL-3.0-or-later
// A typeface with the letters of a language: JUCE draws boxes for those that a typeface lacks, and looks for
// no other one.
#pragma once
#include "Lab/Files/Words.h"
#include <juce_gui_basics/juce_gui_basics.h>
#include <optional>

namespace physvib {

/// Whether the typeface of that name (empty: the usual one) draws each of the letters as itself. M.
bool hasLetters(const juce::String& typeface, const juce::String& letters);

/// A typeface for all that the words say: the usual one if it can, else one that is installed; none: no
/// installed one can. M.
std::optional<juce::String> typefaceFor(const Words& words);
std::optional<juce::String> typefaceFor(const juce::String& letters); ///< the same of letters

/// While it lives, everything is drawn with that typeface, then with the one before. M.
class StudyFont {
public:
    explicit StudyFont(const juce::String& typeface);
    ~StudyFont() { use(before_); }
    StudyFont(const StudyFont&) = delete;
    StudyFont& operator=(const StudyFont&) = delete;

private:
    static void use(const juce::String& typeface);
    juce::String before_;
};

} // namespace physvib
