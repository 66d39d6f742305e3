// SPDX-License-Identifier: GPL-3.0-or-later
// What the desk and all that stands around it have in common: words as JUCE takes them, and a clock.
#pragma once
#include <juce_core/juce_core.h>
#include <string>

namespace physvib {

/// Any thread.
inline juce::String utf8(const std::string& words) { return juce::String::fromUTF8(words.c_str()); }

/// Names of built-in scenes as people write them: "shake-the-box" as "Shake the box".
inline juce::String titleOf(const std::string& name) {
    const auto words = utf8(name).replaceCharacter('-', ' ');
    return words.substring(0, 1).toUpperCase() + words.substring(1);
}

/// Of the clock that what is seen moves by; nothing that is rendered depends on it.
inline double nowMs() { return juce::Time::getMillisecondCounterHiRes(); }

} // namespace physvib
