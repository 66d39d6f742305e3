// SPDX-License-Identifier: MIT
// Frequency and decay of a material from the sound of one contact (thesis 5.2.1).
#pragma once
#include "Io/Result.h"
#include <vector>

namespace physvib {

/// How the two numbers are found.
enum class MaterialRule {
    fit, ///< decaying sinusoids are fitted to the hit; the one with the highest spectral peak in the band is
         ///< taken
    twoPeaks ///< the thesis': highest spectral peak; exp(-tau t) through the two highest peaks in time
};

struct ExtractionBand {
    double lowHz = 20.0, highHz = 1000.0; ///< what is felt
};

/// What one contact sounds like.
struct ContactSound {
    double frequencyHz = 0.0;
    double decayPerSecond = 0.0;
    /// standard errors (HitFit::errorOf); 0 with twoPeaks
    double frequencyErrorHz = 0.0, decayErrorPerSecond = 0.0;
    double residualShare = 0.0; ///< of the hit's energy: what frequency, decay and the other partials do not
                                ///< explain
    double ownShare = 0.0;      ///< of the hit's energy: what this partial explains
    int partials = 0;           ///< found, in the band or not
    double beginSeconds = 0.0, lengthSeconds = 0.0; ///< the excerpt
    bool isConfident() const noexcept; ///< errors within 0.5 % and 5 %, and most of the hit is explained
};

/// Extracts from samples in [-1, 1]; or one line without a file's name: "expected a hit, found silence". M
/// only.
Result<ContactSound> extractMaterial(const std::vector<float>& samples, double rateHz,
                                     ExtractionBand band = {}, MaterialRule rule = MaterialRule::fit);

} // namespace physvib
