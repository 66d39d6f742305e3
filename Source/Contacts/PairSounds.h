// SPDX-License-Identifier: MIT
// Sounds of pairs of surfaces, where a pair sounds different from either surface.
#pragma once
#include "Contacts/HapticFixture.h"
#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace physvib {

/// The sound of a haptic source when a fixture of the other kind collides with it, whatever its voice.
struct PairSound {
    double frequencyHz = 0.0;    ///< 0: silent
    double decayPerSecond = 0.0; ///< of that mode
    Overtones overtones{};       ///< further modes
    double gain = 1.0;           ///< factor on the source's gain
    SoundNumber sound = 0;       ///< of events of the first mode, for which there may be a recording
};

/// By the numbers of two kinds (HapticFixture::surface), in any order. World thread (M) only.
class PairSounds {
public:
    /// Sets or replaces the sound of a pair. Returns the error, and nothing is changed; empty: it is set.
    /// Allocates.
    std::string_view set(int surface, int other, const PairSound& sound) {
        if (surface <= 0 || other <= 0) return "surface: expected more than 0";
        if (const std::string_view fault = faultOf({.frequencyHz = sound.frequencyHz,
                                                    .decayPerSecond = sound.decayPerSecond,
                                                    .overtones = sound.overtones,
                                                    .gain = sound.gain,
                                                    .sound = sound.sound});
            !fault.empty())
            return fault;
        const auto pair = pairOf(surface, other);
        if (const auto known = placeOf(pair); known != sounds_.end() && known->pair == pair)
            sounds_[static_cast<std::size_t>(known - sounds_.begin())].sound = sound;
        else
            sounds_.insert(known, {pair, sound});
        return {};
    }

    /// nullptr: the pair has no sound of its own.
    const PairSound* find(int surface, int other) const noexcept {
        if (surface <= 0 || other <= 0) return nullptr;
        const auto pair = pairOf(surface, other);
        const auto known = placeOf(pair);
        return known != sounds_.end() && known->pair == pair ? &known->sound : nullptr;
    }

private:
    using Pair = std::pair<int, int>; // the smaller number first
    struct Entry {
        Pair pair;
        PairSound sound;
    };
    static Pair pairOf(int surface, int other) noexcept { return std::minmax(surface, other); }
    std::vector<Entry>::const_iterator placeOf(Pair pair) const noexcept {
        return std::ranges::lower_bound(sounds_, pair, {}, &Entry::pair);
    }

    std::vector<Entry> sounds_; // in order of their pairs
};

} // namespace physvib
