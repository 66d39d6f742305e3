// SPDX-License-Identifier: GPL-3.0-or-later
// Selects a typeface with the letters of a language, because JUCE draws boxes for missing letters instead of
// substituting another typeface.
#pragma once
#include "Lab/Files/Translation.h"
#include <juce_gui_basics/juce_gui_basics.h>
#include <memory>
#include <optional>

namespace physvib {

/// True if the typeface (empty: the default) has all the letters. Message thread.
bool hasLetters(const juce::String& typeface, const juce::String& letters);

/// A typeface for all texts of a translation: the default if possible, else an installed one; nullopt if
/// there is none. Message thread.
std::optional<juce::String> typefaceFor(const Translation& words);
std::optional<juce::String> typefaceFor(const juce::String& letters); ///< for these letters

/// Uses that typeface for all text during its lifetime, then restores the previous one. Message thread.
class TypefaceOverride {
public:
    explicit TypefaceOverride(const juce::String& typeface);
    ~TypefaceOverride() { apply(previous_); }
    TypefaceOverride(const TypefaceOverride&) = delete;
    TypefaceOverride& operator=(const TypefaceOverride&) = delete;

private:
    static void apply(const juce::String& typeface);
    juce::String previous_;
};

/// Selects an installed typeface with all letters displayed so far, if there is one. Message thread.
class DisplayTypeface {
public:
    /// True if the typeface changed, so that everything must be redrawn. Cheap if there is no new letter.
    bool ensureLetters(const juce::String& shownText);

private:
    juce::String letters_; // non-ASCII letters, each once
    std::unique_ptr<TypefaceOverride> font_;
};

} // namespace physvib
