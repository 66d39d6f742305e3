// SPDX-License-Identifier: MIT
// Sounds of pairs of surfaces, where a pair sounds different from either surface.
#pragma once
#include "Contacts/HapticFixture.h"
#include "Contacts/IntegerMap.h"
#include <cstddef>
#include <string_view>
#include <vector>

namespace physvib {

/// The sound of a haptic source when a fixture of the other kind collides with it, whatever its voice.
struct PairSound {
    double frequencyHz = 0.0;    ///< 0: silent
    double decayPerSecond = 0.0; ///< of that mode
    Overtones overtones{};       ///< further modes
    double gain = 1.0;           ///< factor on the source's gain
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
                                                    .gain = sound.gain});
            !fault.empty())
            return fault;
        if (const std::int32_t known = indices_.find(pairKey(surface, other)); known != IntegerMap::none) {
            sounds_[static_cast<std::size_t>(known)] = sound;
        } else {
            indices_.set(pairKey(surface, other), static_cast<std::int32_t>(sounds_.size()));
            sounds_.push_back(sound);
        }
        return {};
    }

    /// nullptr: the pair has no sound of its own.
    const PairSound* find(int surface, int other) const noexcept {
        if (sounds_.empty() || surface <= 0 || other <= 0) return nullptr;
        const std::int32_t known = indices_.find(pairKey(surface, other));
        return known == IntegerMap::none ? nullptr : &sounds_[static_cast<std::size_t>(known)];
    }

private:
    std::vector<PairSound> sounds_;
    IntegerMap indices_;
};

} // namespace physvib
