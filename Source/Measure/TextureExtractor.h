// SPDX-License-Identifier: MIT
// A surface's grains from the recording of a scrape, or from an autoregressive model of one.
#pragma once
#include "Contacts/Texture.h"
#include "Io/Result.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// How something was drawn over the surface.
struct Scrape {
    double metresPerSecond = 0.0; ///< all the time
    double loadNewtons = 1.0;     ///< that pressed
    double massKg = 1.0;          ///< of what vibrated
};

struct ScrapedTexture {
    Texture texture; ///< its roughness is 1 where the strength is not told
    double grainsPerSecond = 0.0;
    double strength = 0.0; ///< of a grain, in the recording's full scale or the model's m/s^2; 0: not told
    double frequencyHz = 0.0, decayPerSecond = 0.0; ///< of what rings; 0: not told
    std::size_t counted = 0;                        ///< grains that stood out of a recording
    double lostShare = 0.0; ///< and the share that did not, by what is known of chance
};

/// From samples in [-1, 1], of which the middle 8 s are used (or 400,000 samples); or one line without a
/// file's name: "expected a scrape, found silence". A grain is taken for a blow as Eq. 5.4 makes one with A*
/// and a drive gain of 1: full scale for 1 N s on 1 kg. M only.
Result<ScrapedTexture> extractTexture(const std::vector<float>& samples, double rateHz, const Scrape& scrape);

/// y[n] = noise[n] - sum a[k] y[n - k]: an acceleration in m/s^2.
struct AutoregressiveModel {
    double rateHz = 0.0;
    double variance = 0.0;            ///< of the noise
    std::vector<double> coefficients; ///< a[1], a[2]...
};

/// What rings is the highest peak of its spectrum from 20 to 1000 Hz; there are two random grains in each of
/// its periods, together as strong as the model is in that band. M only.
Result<ScrapedTexture> textureOf(const AutoregressiveModel& model, const Scrape& scrape);

} // namespace physvib
