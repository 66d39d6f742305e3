// SPDX-License-Identifier: MIT
// Clips: recordings that are played by number and belong to no material. Each is identified by a frequency
// far below the tactile range that no material uses.
#pragma once

namespace physvib {

constexpr int mostClips = 32; ///< channels of clips that a session keeps; small, because each strike searches
                              ///< them linearly

/// The frequency that identifies clip `number`, from 0 on, exact in a float. Any thread.
constexpr double clipFrequencyHz(int number) noexcept { return (number + 1) / 1024.0; }

/// True if the frequency identifies a clip. Any thread.
constexpr bool isClip(double frequencyHz) noexcept { return frequencyHz <= clipFrequencyHz(mostClips - 1); }

} // namespace physvib
