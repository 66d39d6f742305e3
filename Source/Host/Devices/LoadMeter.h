// SPDX-License-Identifier: GPL-3.0-or-later
// Counts rendered blocks and measures the share of their duration that rendering takes.
#pragma once
#include "Live/Session/Session.h"
#include <algorithm>
#include <cstdint>
#include <juce_core/juce_core.h>

namespace physvib {

class LoadMeter {
public:
    struct Load {
        std::uint64_t blocks = 0;
        float last = 0.0f, worst = 0.0f; ///< processing time / duration
    };

    /// A block of `frames` that started at `startTicks` of JUCE's clock has been rendered. R, wait-free.
    void take(juce::int64 startTicks, int frames, int sampleRateHz) noexcept {
        const double taken =
            juce::Time::highResolutionTicksToSeconds(juce::Time::getHighResolutionTicks() - startTicks);
        measured_.last = static_cast<float>(taken * sampleRateHz / frames);
        measured_.worst = std::max(measured_.worst, measured_.last);
        ++measured_.blocks;
        load_.write(measured_);
    }

    /// M.
    Load read() noexcept { return load_.read(); }

private:
    LatestValue<Load> load_;
    Load measured_; // R
};

} // namespace physvib
