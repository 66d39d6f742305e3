// SPDX-License-Identifier: MIT
// Extracts a material's frequency and decay from the recording of one contact (thesis 5.2.1).
#pragma once
#include "Io/Result.h"
#include <vector>

namespace physvib {

/// How frequency and decay are determined.
enum class MaterialRule {
    fit,     ///< fits decaying sinusoids; takes the one with the highest spectral peak in the band
    twoPeaks ///< the thesis' rule: highest spectral peak; exp(-tau t) through the two highest peaks in time
};

struct ExtractionBand {
    double lowHz = 20.0, highHz = 1000.0; ///< tactile range
};

/// A partial beside the material's own; `amplitude` is relative to that.
struct FurtherPartial {
    double frequencyHz = 0.0, decayPerSecond = 0.0, amplitude = 0.0;
};

/// Estimated sound of one contact.
struct ContactSound {
    double frequencyHz = 0.0;
    double decayPerSecond = 0.0;
    std::vector<FurtherPartial> furtherPartials; ///< in the band, the highest spectral peak first; none with
                                                 ///< twoPeaks
    /// standard errors (HitFit::stdError); 0 with twoPeaks
    double frequencyErrorHz = 0.0, decayErrorPerSecond = 0.0;
    double residualShare = 0.0;  ///< share of the impact's energy that the fitted partials do not explain
    double explainedShare = 0.0; ///< share of the impact's energy that this partial explains
    int partialCount = 0;        ///< number found, in the band or not
    double beginSeconds = 0.0, lengthSeconds = 0.0; ///< the excerpt
    /// errors within 0.5 % and 5 %, and most of the impact is explained
    bool isConfident() const noexcept {
        return frequencyErrorHz > 0.0 && frequencyErrorHz < 0.005 * frequencyHz &&
               decayErrorPerSecond < 0.05 * decayPerSecond && residualShare < 0.5;
    }
};

/// Extracts from samples in [-1, 1]. Otherwise a one-line error without a file's name: "expected a hit, found
/// silence". Message thread (M) only.
Result<ContactSound> extractMaterial(const std::vector<float>& samples, double rateHz,
                                     ExtractionBand band = {}, MaterialRule rule = MaterialRule::fit);

} // namespace physvib
