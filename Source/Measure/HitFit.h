// SPDX-License-Identifier: MIT
// Fits the partials of one impact together with its onset, which is not known exactly.
#pragma once
#include "Measure/PartialFit.h"
#include "Measure/StruckFit.h"
#include <cstddef>
#include <optional>
#include <vector>

namespace physvib {

/// Adds partials one by one while each explains more than noise would, and moves the onset to where the model
/// explains most. Overlapping partials are also searched from other starts. Where Eq. 5.1 (all partials begin
/// at one moment, at rest) explains the impact as well as free phases do, it is preferred, because it has
/// fewer parameters. Message thread (M) only.
class HitFit {
public:
    /// `guess`: initial onset in `samples`; it moves by at most onsetReachSeconds per partial.
    HitFit(std::vector<double> samples, std::size_t guess, double rateHz);
    HitFit(const HitFit&) = delete; // the fits refer to the samples
    HitFit& operator=(const HitFit&) = delete;

    /// time 0 is the onset
    std::vector<Partial> partials() const { return struck_ ? struck_->partials() : fit_.partials(); }
    /// Cramer-Rao bound for noise with the residual's density around the partial
    PartialError errorOf(std::size_t partial) const;
    double onsetSeconds() const noexcept {
        return struck_ ? struck_->onsetSeconds() : static_cast<double>(onset_) / rateHz_;
    }
    /// after the onset
    double seconds() const noexcept {
        return static_cast<double>(samples_.size()) / rateHz_ - onsetSeconds();
    }
    double energy() const noexcept { return energy_; }
    double unexplainedEnergy() const {
        return struck_ ? struck_->residualEnergy() : energyBeforeOnset() + fit_.residualEnergy();
    }

private:
    void addPartials();
    void tryOtherStarts();
    void tryFree(const std::vector<Partial>& starts);
    void tryStruck(const std::vector<Partial>& starts);
    bool moveOnset();
    void restart(std::size_t onset, const std::vector<Partial>& partials);
    double energyBeforeOnset() const;
    double noiseAbout(const Partial& partial) const;
    double costOf(double unexplained, std::size_t numbers) const;
    std::span<const double> rest() const { return std::span(samples_).subspan(onset_); }

    std::vector<double> samples_;
    std::size_t onset_;
    double rateHz_;
    double energy_;
    PartialFit fit_;
    std::optional<StruckFit> struck_; ///< set if Eq. 5.1 fits better
    double cost_ = 0.0;
};

} // namespace physvib
