// SPDX-License-Identifier: MIT
// Extracts a surface's grains (spacing, pattern, roughness) from the recording of a scrape.
#pragma once
#include "Contacts/Grains.h"
#include "Io/Result.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// The conditions of a scrape.
struct Scrape {
    double metresPerSecond = 0.0; ///< constant
    double loadNewtons = 1.0;     ///< normal force
    double massKg = 1.0;          ///< of the vibrating object
};

struct ScrapedTexture {
    Texture texture; ///< its roughness is 1 if the strength is not known
    double grainsPerSecond = 0.0;
    double strength = 0.0; ///< of a grain, in the recording's full scale; 0: not known
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of the resonance; 0: not known
    std::size_t grainCount = 0;                     ///< grains that stood out in a recording
    double lostShare = 0.0;                         ///< estimated share of grains that did not
};

/// From samples in [-1, 1], of which the middle 8 s (or 400,000 samples) are used. Otherwise a one-line error
/// without a file's name: "expected a scrape, found silence". A grain counts as an impact in Eq. 5.4 with A*
/// and a drive gain of 1: full scale for 1 N s on 1 kg. Message thread (M) only.
Result<ScrapedTexture> extractTexture(const std::vector<float>& samples, double rateHz, const Scrape& scrape);

} // namespace physvib
