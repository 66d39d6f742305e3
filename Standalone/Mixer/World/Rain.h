// SPDX-License-Identifier: GPL-3.0-or-later
// Rain that comes ball by ball, and fountains.
#pragma once
#include "Mixer/Model/MixerModel.h"
#include <cstdint>
#include <vector>

namespace physvib {

/// How the bodies of a rain come: all at once, so many in a second of the world, or so many upwards from one
/// place.
struct RainPattern {
    int perSecond = 0; ///< 0: all at once
    bool isFountain = false;
    bool operator==(const RainPattern&) const = default;
};

/// Adds the bodies of one rain to the scene when the time of its world has come to them. All of them are one
/// step of undoing. Message thread.
class Rain {
public:
    explicit Rain(MixerModel& model)
        : model_{model} {}
    const RainPattern& pattern() const noexcept { return pattern_; }
    void setPattern(const RainPattern& pattern) { pattern_ = pattern; }
    void begin(std::vector<BodyDescription> bodies); ///< with names and materials, the first to come first
    void spawnDueBodies();                           ///< adds those that are due; to be called often

private:
    MixerModel& model_;
    RainPattern pattern_;
    std::vector<BodyDescription> falling_;  // those that are still to come, the next last
    std::int64_t fromNs_ = 0, spawned_ = 0; // time of the scene, and how many have come since
};

} // namespace physvib
