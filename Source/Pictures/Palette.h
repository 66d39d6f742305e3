// SPDX-License-Identifier: MIT
// PhysVib's colours: backgrounds, actuators, materials. An actuator has the same colour everywhere.
#pragma once
#include "Pictures/Image.h"
#include <array>
#include <cstddef>

namespace physvib::picture::palette {

inline constexpr Colour ground = Colour::of(0xff121317);
inline constexpr Colour panel = Colour::of(0xff1a1c23);
inline constexpr Colour well = Colour::of(0xff0e0f12);
inline constexpr Colour line = Colour::of(0xff2b2e38);
inline constexpr Colour text = Colour::of(0xffe6e8ee);
inline constexpr Colour muted = Colour::of(0xff959bab);
inline constexpr Colour white = Colour::of(0xffffffff);
inline constexpr Colour highlight = Colour::of(0xfff6c667); ///< amber: events of this moment
inline constexpr Colour limit = Colour::of(0xfff56565);     ///< red: only stop and limits
inline constexpr Colour camera = Colour::of(0xffd8c69a);    ///< outline of what is felt
inline constexpr Colour grey = Colour::of(0xff6b7180);      ///< events without a known material

/// Colour of an actuator: eight chosen by eye, then hues a golden angle apart. Any thread.
inline Colour actuator(int index) {
    constexpr std::array<std::uint32_t, 8> colours{0xff4fd1c5, 0xfff6ad55, 0xffb794f4, 0xff68d391,
                                                   0xff63b3ed, 0xfff687b3, 0xffd6d765, 0xffa3b1c6};
    if (index < static_cast<int>(colours.size())) return Colour::of(colours[static_cast<std::size_t>(index)]);
    const float turns = 0.38196601f * static_cast<float>(index);
    return Colour::ofHue(turns - std::floor(turns), 0.55f, index % 2 == 0 ? 0.70f : 0.60f);
}

constexpr int materialCount = 8;

/// Colour of a material by its index; calm, so that amber and the actuators stand out. Any thread.
inline Colour material(int index) {
    constexpr std::array<std::uint32_t, materialCount> colours{
        0xffd14b5a, 0xffc98d3c, 0xff9fb3cb, 0xffa79fb5, 0xffb7906b, 0xff5a93c9, 0xffa9744f, 0xff9aa04a};
    return Colour::of(colours[static_cast<std::size_t>(index) % colours.size()]);
}

/// Colour of material `index` of `list`: its own if set, else by the index, also outside it. Any thread.
Colour materialOf(const auto& list, int index) {
    const bool isListed = index >= 0 && index < static_cast<int>(list.size());
    const int assigned = isListed ? list[static_cast<std::size_t>(index)].colour : 0;
    return material(assigned > 0 ? assigned - 1 : index);
}

constexpr int rampCount = 6;

/// Colour of a frequency class, low (cool) to high (warm). Any thread.
inline Colour ramp(int index) {
    constexpr std::array<std::uint32_t, rampCount> colours{0xff7b74d4, 0xff4f93d8, 0xff3fb5a6,
                                                           0xff86c96a, 0xffd9bf55, 0xffe0844f};
    return Colour::of(colours[static_cast<std::size_t>(index) % colours.size()]);
}

} // namespace physvib::picture::palette
