// SPDX-License-Identifier: MIT
// Removes content below limits::slowestToneHz from samples for actuators: it cannot be felt and only warms a
// coil.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace physvib {

/// What was removed, in shares of full scale; 0: too little, and the samples are unchanged.
struct SlowPart {
    static constexpr double leastSeconds = 0.2; ///< a period of limits::slowestToneHz: shorter samples have
                                                ///< no slow part
    static constexpr double leastMean = 0.01, leastRest = 0.1;

    double mean = 0.0; ///< maximum over the channels, like `rest`
    double rest = 0.0; ///< peak of the varying part below that frequency

    bool isAny() const noexcept { return mean != 0.0 || rest != 0.0; }
    void join(const SlowPart& other) noexcept {
        mean = std::max(mean, other.mean);
        rest = std::max(rest, other.rest);
    }
    /// A note for the user; empty if nothing was removed. Any thread.
    std::string text() const;
};

/// Subtracts the mean, and then, if it reaches leastRest, what is left below limits::slowestToneHz: a running
/// mean over leastSeconds with triangular weights (-4.5 dB at 5 Hz, -18 dB at 2 Hz, -30 dB at 1 Hz; within
/// 0.5 dB from 10 Hz on). `fullScale`: the sample value that is played as full scale. Any thread but the
/// render thread (R).
SlowPart takeSlowPart(std::vector<float>& samples, double sampleRateHz, double fullScale = 1.0);

} // namespace physvib
