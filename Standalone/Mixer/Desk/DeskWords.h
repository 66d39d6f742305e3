// SPDX-License-Identifier: GPL-3.0-or-later
// Helpers of the mixer's classes: conversion of text to JUCE strings, and a clock.
#pragma once
#include <juce_core/juce_core.h>
#include <string>

namespace physvib {

/// Any thread.
inline juce::String utf8(const std::string& words) { return juce::String::fromUTF8(words.c_str()); }

/// Displayed names of built-in scenes: "shake-the-box" as "Shake the box".
inline juce::String titleOf(const std::string& name) {
    const auto words = utf8(name).replaceCharacter('-', ' ');
    return words.substring(0, 1).toUpperCase() + words.substring(1);
}

/// Clock for display animation; rendered output does not depend on it.
inline double nowMs() { return juce::Time::getMillisecondCounterHiRes(); }

} // namespace physvib
