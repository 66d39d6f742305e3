// SPDX-License-Identifier: GPL-3.0-or-later
// The colours of PhysVib: grounds, enchanters, materials. One colour per enchanter wherever it is shown.
#pragma once
#include <array>
#include <juce_graphics/juce_graphics.h>

namespace physvib::palette {

using Argb = juce::uint32;

inline const juce::Colour ground{Argb{0xff121317}};
inline const juce::Colour panel{Argb{0xff1a1c23}};
inline const juce::Colour well{Argb{0xff0e0f12}};
inline const juce::Colour line{Argb{0xff2b2e38}};
inline const juce::Colour text{Argb{0xffe6e8ee}};
inline const juce::Colour muted{Argb{0xff959bab}};
inline const juce::Colour now{Argb{0xfff6c667}};    ///< amber: what happens at this moment
inline const juce::Colour limit{Argb{0xfff56565}};  ///< red: stop and limit, nothing else
inline const juce::Colour camera{Argb{0xffd8c69a}}; ///< outline of what is felt
inline const juce::Colour other{Argb{0xff6b7180}};  ///< what has no material

/// Colour of an enchanter: eight chosen by eye, then hues a golden angle apart so that neighbours differ.
inline juce::Colour enchanter(int index) {
    constexpr std::array<Argb, 8> chosen{0xff4fd1c5, 0xfff6ad55, 0xffb794f4, 0xff68d391,
                                         0xff63b3ed, 0xfff687b3, 0xffd6d765, 0xffa3b1c6};
    if (index < static_cast<int>(chosen.size())) return juce::Colour(chosen[static_cast<std::size_t>(index)]);
    const float turns = 0.38196601f * static_cast<float>(index);
    return juce::Colour::fromHSL(turns - std::floor(turns), 0.55f, index % 2 == 0 ? 0.70f : 0.60f, 1.0f);
}

constexpr int materialCount = 8;

/// Colour of a material by its index in the scene; calm, so that amber and the enchanters stand out.
inline juce::Colour material(int index) {
    constexpr std::array<Argb, materialCount> chosen{0xffd14b5a, 0xffc98d3c, 0xff9fb3cb, 0xffa79fb5,
                                                     0xffb7906b, 0xff5a93c9, 0xffa9744f, 0xff9aa04a};
    return juce::Colour(chosen[static_cast<std::size_t>(index) % chosen.size()]);
}

constexpr int rampCount = 6;

/// Colour of a frequency class, low (cool) to high (warm).
inline juce::Colour ramp(int index) {
    constexpr std::array<Argb, rampCount> chosen{0xff7b74d4, 0xff4f93d8, 0xff3fb5a6,
                                                 0xff86c96a, 0xffd9bf55, 0xffe0844f};
    return juce::Colour(chosen[static_cast<std::size_t>(index) % chosen.size()]);
}

} // namespace physvib::palette
