// SPDX-License-Identifier: MIT
// Fits the partials of one impact together with its onset, which is not known exactly.
#pragma once
#include "Measure/PartialFit.h"
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace physvib {

/// A partial of Eq. 5.1 that begins with all others, at rest: amplitude sin(omega (t - onset)) exp(-tau (t -
/// onset)) from the onset on; the amplitude may be negative.
struct CommonOnsetPartial {
    double omega = 0.0, tau = 0.0, amplitude = 0.0;
};

/// Samples x[i] at i / rateHz seconds; silence before the onset, which may lie between samples. One parameter
/// fewer per partial than with free phases, so that overlapping partials can be separated. Message thread (M)
/// only.
class CommonOnsetFit {
public:
    /// `samples` must outlive the fit. The partials' phases and amplitudes only guide the search for the
    /// onset: time 0 is sample `onset`.
    CommonOnsetFit(std::span<const double> samples, double rateHz, std::size_t onset,
                   std::span<const Partial> partials);

    bool refine();
    double residualEnergy() const { return residualEnergy(state_); }
    double onsetSeconds() const noexcept { return state_.onset; }
    std::vector<Partial> partials() const; ///< time 0 is the onset
    PartialError stdError(std::size_t partial) const;

private:
    static constexpr std::size_t parametersPerPartial = 3; ///< parameters of a partial
    struct State {
        double onset = 0.0;
        std::vector<CommonOnsetPartial> partials;
    };
    std::vector<double> residual(const State& state) const;
    double residualEnergy(const State& state) const;
    NormalEquations makeEquations(const State& state) const;
    State solveAmplitudes(double onset, State state) const;
    State takeStep(const State& state, std::span<const double> step) const;
    std::size_t firstSample(const State& state) const;

    std::span<const double> samples_;
    double rateHz_;
    State state_;
};

/// Adds partials one by one while each explains more than noise would, and moves the onset to where the model
/// explains most. Overlapping partials are also searched from other starts. Where Eq. 5.1 (all partials begin
/// at one moment, at rest) explains the impact as well as free phases do, it is preferred, because it has
/// fewer parameters. Message thread (M) only.
class HitFit {
public:
    static constexpr std::size_t defaultPartials = 6;
    /// 1/s; a partial with a slower decay was there before the impact: hum.
    static constexpr double minTau = 0.5;
    /// `initialOnset`: an index of `samples`, which moves by at most onsetReachSeconds per partial.
    HitFit(std::vector<double> samples, std::size_t initialOnset, double rateHz,
           std::size_t maxPartials = defaultPartials);
    HitFit(const HitFit&) = delete; // the fits refer to the samples
    HitFit& operator=(const HitFit&) = delete;

    /// Fitted partials; their time 0 is the onset.
    std::vector<Partial> partials() const {
        return commonOnset_ ? commonOnset_->partials() : fit_.partials();
    }
    /// Standard errors: Cramer-Rao bound for noise of the residual's density around the partial.
    PartialError stdError(std::size_t partial) const;
    double onsetSeconds() const noexcept {
        return commonOnset_ ? commonOnset_->onsetSeconds() : static_cast<double>(onset_) / rateHz_;
    }
    /// Length of the samples after the onset.
    double seconds() const noexcept {
        return static_cast<double>(samples_.size()) / rateHz_ - onsetSeconds();
    }
    double energy() const noexcept { return energy_; }
    double unexplainedEnergy() const {
        return commonOnset_ ? commonOnset_->residualEnergy() : energyBeforeOnset() + fit_.residualEnergy();
    }

private:
    void addPartials();
    void tryOtherStarts();
    void tryFreePhases(const std::vector<Partial>& starts);
    void tryCommonOnset(const std::vector<Partial>& starts);
    bool moveOnset();
    void restart(std::size_t onset, const std::vector<Partial>& partials);
    double energyBeforeOnset() const;
    double noiseDensityAround(const Partial& partial) const;
    double modelCost(double unexplained, std::size_t parameterCount) const;
    std::span<const double> afterOnset() const { return std::span(samples_).subspan(onset_); }

    std::vector<double> samples_;
    std::size_t onset_;
    double rateHz_;
    std::size_t maxPartials_;
    double energy_;
    PartialFit fit_;
    std::optional<CommonOnsetFit> commonOnset_; ///< set if Eq. 5.1 fits better
    double cost_ = 0.0;
};

} // namespace physvib
