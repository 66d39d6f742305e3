// SPDX-License-Identifier: MIT
// Numbers that stand in events for names: of sounds, and of parts of a body.
#pragma once
#include "Core/Limits.h"
#include <cstdint>
#include <limits>
#include <string_view>

namespace physvib {

/// The hash function FNV-1a in 64 bits, for short names and lines: not for files, nor against forgery.
/// `from`: the hash of what precedes `text`. Any thread.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t from = 0xcbf29ce484222325u) noexcept {
    for (const char c : text) from = (from ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    return from;
}

// Parts of a body (palm, thumb, chest) as numbers: actuators belong to one, events may be felt on one alone.

using PartNumber = std::int32_t; ///< 0: none; above: of a name

/// The number of a part, which follows from its name alone, as that of a sound; "": 0. Two names share a
/// number with a probability of 5e-10. Any thread.
constexpr PartNumber partNamed(std::string_view name) noexcept {
    if (name.empty()) return 0;
    return static_cast<PartNumber>(fnv1a(name) % std::numeric_limits<PartNumber>::max()) + 1;
}

// Numbers of sounds. An event's number says which recording plays it, if there is one: a clip, or the
// recorded contact of its material. An event without a number, or whose number has no recording, is played by
// its frequency and decay.

using SoundNumber = std::int32_t; ///< 0: none; 1 to maxClips: clips; above: materials

constexpr int maxClips = 32; ///< channels of clips that a session keeps; few: each strike searches them all

/// The frequency of an event that plays a clip. Samples have none, but an event needs one that can be played.
constexpr double clipFrequencyHz = limits::slowestToneHz;

/// The number of clip `clip`, from 0 on. Any thread.
constexpr SoundNumber soundOfClip(int clip) noexcept { return clip + 1; }

/// True if the number is that of a clip. Any thread.
constexpr bool isClip(SoundNumber sound) noexcept { return sound > 0 && sound <= maxClips; }

/// The number of a material, which follows from its name alone. It is therefore the same in every scene, list
/// and session, and no table has to travel with the events. Two names share a number with a probability of
/// 5e-10; a scene that has such a pair is refused. Any thread.
constexpr SoundNumber soundOfMaterial(std::string_view name) noexcept {
    constexpr std::uint64_t numbers = std::numeric_limits<SoundNumber>::max() - maxClips;
    return static_cast<SoundNumber>(fnv1a(name) % numbers) + maxClips + 1;
}

} // namespace physvib
