// SPDX-License-Identifier: GPL-3.0-or-later
// Selects a typeface with the letters of a language, because JUCE draws boxes for missing letters instead of
// substituting another typeface.
#pragma once
#include "Lab/Files/Words.h"
#include <juce_gui_basics/juce_gui_basics.h>
#include <memory>
#include <optional>

namespace physvib {

/// True if the typeface (empty: the default) has all the letters. Message thread.
bool hasLetters(const juce::String& typeface, const juce::String& letters);

/// A typeface for all texts of a translation: the default if possible, else an installed one; nullopt if
/// there is none. Message thread.
std::optional<juce::String> typefaceFor(const Words& words);
std::optional<juce::String> typefaceFor(const juce::String& letters); ///< the same for given letters

/// Uses that typeface for all text during its lifetime, then restores the previous one. Message thread.
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

/// Selects a typeface for letters of other scripts, because JUCE draws boxes for letters that its typeface
/// lacks.
/// Uses an installed typeface with all displayed letters, if there is one. Message thread.
class ShownLetters {
public:
    /// True if the typeface changed, so that everything must be redrawn. Cheap if there is no new letter.
    bool show(const juce::String& words);

private:
    juce::String letters_; // non-ASCII letters, each once
    std::unique_ptr<StudyFont> font_;
};

} // namespace physvib
