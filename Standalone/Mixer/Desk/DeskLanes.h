// SPDX-License-Identifier: GPL-3.0-or-later
// Records fader moves during a recording as automation lanes over the scene's time.
#pragma once
#include "Live/Documents/Strip.h"
#include <cstddef>
#include <vector>

namespace physvib {

class Desk;

/// Message thread only.
class DeskLanes {
public:
    /// `desk` outlives it.
    explicit DeskLanes(Desk& desk)
        : desk_{desk} {}

    void look(); ///< to be called often

private:
    struct Fader {
        double startDb = 0.0, nowDb = 0.0;
        GainLane moves{}; ///< its values, in dB
    };
    std::vector<double> faders() const; ///< values of all strips, then of all groups
    double sceneSeconds() const;
    void begin();
    void follow();
    void end();

    Desk& desk_;
    std::vector<Fader> faders_; // empty: not recording
    std::size_t strips_ = 0, take_ = 0;
    double lookedAtSeconds_ = 0.0;
};

} // namespace physvib
