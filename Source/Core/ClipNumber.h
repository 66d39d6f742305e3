// SPDX-License-Identifier: MIT
// Clips are recordings that stand for no material: known by frequencies that nothing else has, far below what
// is felt.
#pragma once

namespace physvib {

constexpr int mostClips = 32; ///< channels of clips that a session keeps: a strike looks through them

/// The frequency of clip `number`, from 0 on, exact in a float. Any thread.
constexpr double clipFrequencyHz(int number) noexcept { return (number + 1) / 1024.0; }

/// Any thread.
constexpr bool isClip(double frequencyHz) noexcept { return frequencyHz <= clipFrequencyHz(mostClips - 1); }

} // namespace physvib
