// SPDX-License-Identifier: GPL-3.0-or-later
// Partials of one hit whose onset is not known exactly: both are found together.
#pragma once
#include "Host/PartialFit.h"
#include <cstddef>
#include <vector>

namespace physvib {

/// Takes partial after partial into the fit, as long as each explains more than noise would, and moves the onset to where
/// the model explains most. M only.
class HitFit {
public:
    /// `guess`: the onset in `samples`, to begin with; it moves by onsetReachSeconds per partial at most.
    HitFit(std::vector<double> samples, std::size_t guess, double rateHz);
    HitFit(const HitFit&) = delete; // the fit refers to the samples
    HitFit& operator=(const HitFit&) = delete;

    const PartialFit& fit() const noexcept { return fit_; } ///< its time 0 is the onset
    std::size_t onset() const noexcept { return onset_; }
    double seconds() const noexcept { return static_cast<double>(samples_.size() - onset_) / rateHz_; } ///< after the onset
    double energy() const noexcept { return energy_; }
    double unexplainedEnergy() const;

private:
    void run();
    bool moveOnset();
    void restart(std::size_t onset, const std::vector<Partial>& partials);
    std::span<const double> rest() const { return std::span(samples_).subspan(onset_); }

    std::vector<double> samples_;
    std::size_t onset_;
    double rateHz_;
    double energy_;
    PartialFit fit_;
};

} // namespace physvib
