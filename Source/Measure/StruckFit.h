// SPDX-License-Identifier: MIT
// Least-squares fit of Eq. 5.1: partials that all begin at one moment, at rest.
#pragma once
#include "Measure/LeastSquares.h"
#include "Measure/PartialFit.h"
#include <span>
#include <vector>

namespace physvib {

/// amplitude sin(omega (t - onset)) exp(-tau (t - onset)) from the onset on; the amplitude may be negative.
struct StruckPartial {
    double omega = 0.0, tau = 0.0, amplitude = 0.0;
};

/// Samples x[i] at i / rateHz seconds; silence before the onset, which may lie between samples. One parameter
/// fewer per partial than with free phases, so that overlapping partials can be separated. Message thread (M)
/// only.
class StruckFit {
public:
    /// `samples` must outlive the fit. The partials' phases and amplitudes only guide the search for the
    /// onset: time 0 is sample `onset`.
    StruckFit(std::span<const double> samples, double rateHz, std::size_t onset,
              std::span<const Partial> partials);

    bool refine();
    double residualEnergy() const { return energyOf(state_); }
    double onsetSeconds() const noexcept { return state_.onset; }
    std::vector<Partial> partials() const; ///< time 0 is the onset
    PartialError errorOf(std::size_t partial) const;

private:
    struct State {
        double onset = 0.0;
        std::vector<StruckPartial> partials;
    };
    std::vector<double> residual(const State& state) const;
    double energyOf(const State& state) const;
    NormalEquations equationsOf(const State& state) const;
    State solvedAt(double onset, State state) const;
    State moved(const State& state, std::span<const double> step) const;
    std::size_t firstOf(const State& state) const;

    std::span<const double> samples_;
    double rateHz_;
    State state_;
};

} // namespace physvib
