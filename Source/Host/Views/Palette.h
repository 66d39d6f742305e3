// SPDX-License-Identifier: GPL-3.0-or-later
// The colours and number formats of Source/Pictures as JUCE types.
#pragma once
#include "Io/Text/ReadableNumber.h"
#include "Pictures/Palette.h"
#include <juce_graphics/juce_graphics.h>

namespace physvib::palette {

inline juce::Colour juceColour(picture::Colour colour) { return juce::Colour{colour.argb()}; }

inline const juce::Colour ground = juceColour(picture::palette::ground),
                          panel = juceColour(picture::palette::panel),
                          well = juceColour(picture::palette::well),
                          line = juceColour(picture::palette::line),
                          text = juceColour(picture::palette::text),
                          muted = juceColour(picture::palette::muted),
                          now = juceColour(picture::palette::now),
                          limit = juceColour(picture::palette::limit),
                          camera = juceColour(picture::palette::camera),
                          other = juceColour(picture::palette::other);

using Argb = juce::uint32;
using picture::palette::materialCount;

inline juce::Colour enchanter(int index) { return juceColour(picture::palette::enchanter(index)); }
inline juce::Colour material(int index) { return juceColour(picture::palette::material(index)); }
inline juce::Colour ramp(int index) { return juceColour(picture::palette::ramp(index)); }

} // namespace physvib::palette

namespace physvib::readable {

/// number() as a JUCE string. Any thread.
inline juce::String words(double value, int decimals) {
    return juce::String::fromUTF8(number(value, decimals).c_str());
}

} // namespace physvib::readable
