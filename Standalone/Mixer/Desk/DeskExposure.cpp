// SPDX-License-Identifier: GPL-3.0-or-later
// Computes exposure from differences of the output's sums, scaled by each actuator's full scale.
#include "Mixer/Desk/DeskExposure.h"
#include <algorithm>
#include <cmath>

namespace physvib {

void DeskExposure::use(const LayoutDescription& layout) {
    update();
    fullScaleG_.fill(0.0);
    std::ranges::transform(layout.enchanters, fullScaleG_.begin(), &EnchanterDescription::fullScaleG);
}

void DeskExposure::update() {
    const ExposureSums& now = output_.exposure();
    for (std::size_t j = 0; j < fullScaleG_.size(); ++j)
        squareGSeconds_ += (now.weighted[j] - sums_.weighted[j]) * fullScaleG_[j] * fullScaleG_[j];
    sums_ = now;
}

FeltLevel DeskExposure::felt(double seconds) const {
    FeltLevel level;
    if (sums_.mark != mark_ || seconds <= 0.0) return level;
    for (std::size_t j = 0; j < fullScaleG_.size(); ++j) {
        level.peakG = std::max(level.peakG, sums_.peaks[j] * fullScaleG_[j]);
        level.rmsG = std::max(level.rmsG, std::sqrt(sums_.plain[j] / seconds) * fullScaleG_[j]);
    }
    return level;
}

} // namespace physvib
