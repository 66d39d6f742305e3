// SPDX-License-Identifier: GPL-3.0-or-later
// Searches for a typeface when a new letter is to be displayed.
#include "Mixer/Window/ShownLetters.h"

namespace physvib {

bool ShownLetters::show(const juce::String& words) {
    juce::String fresh;
    for (const auto letter : words)
        if (letter > 0x7f && !letters_.containsChar(letter) && !fresh.containsChar(letter)) fresh += letter;
    if (fresh.isEmpty()) return false;
    letters_ += fresh;
    if (hasLetters({}, fresh)) return false;
    const auto typeface = typefaceFor(letters_);
    if (!typeface) return false; // not installed: JUCE draws boxes
    font_.reset();               // only one may exist
    font_ = std::make_unique<StudyFont>(*typeface);
    return true;
}

} // namespace physvib
