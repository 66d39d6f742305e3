// SPDX-License-Identifier: MIT
// What lies below limits::slowestToneHz in samples that are to be felt: nobody feels it, and a coil only
// grows warm of it.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace physvib {

/// What was taken away, in shares of full scale; 0: there was too little of it, and the samples stayed as
/// they were.
struct SlowPart {
    static constexpr double leastSeconds = 0.2; ///< a period of limits::slowestToneHz: what is shorter has no
                                                ///< slow part
    static constexpr double leastMean = 0.01, leastRest = 0.1;

    double mean = 0.0; ///< largest, if there are several channels, as of `rest`
    double rest = 0.0; ///< peak of what varies below that frequency

    bool isAny() const noexcept { return mean != 0.0 || rest != 0.0; }
    void join(const SlowPart& other) noexcept {
        mean = std::max(mean, other.mean);
        rest = std::max(rest, other.rest);
    }
    /// What is said of it; empty if there is nothing to say. Any thread.
    std::string text() const;
};

/// Takes the mean away, and then, if it still reaches leastRest, what is left below limits::slowestToneHz: a
/// running mean over leastSeconds, weighted by a triangle (-4.5 dB at 5 Hz, -18 dB at 2 Hz, -30 dB at 1 Hz;
/// within 0.5 dB from 10 Hz on). `fullScale` is what is played as such. Any thread but R.
SlowPart takeSlowPart(std::vector<float>& samples, double sampleRateHz, double fullScale = 1.0);

} // namespace physvib
