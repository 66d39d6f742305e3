// SPDX-License-Identifier: MIT
// Least-squares fit of a sum of decaying sinusoids (partials) to samples.
#pragma once
#include "Core/Trigonometry.h"
#include "Measure/LeastSquares.h"
#include <cmath>
#include <span>
#include <vector>

namespace physvib {
/// exp(-tau t) (cosine cos(omega t) + sine sin(omega t)), t = seconds since the first fitted sample.
struct Partial {
    double omega = 0.0; ///< rad/s
    double tau = 0.0;   ///< 1/s
    double cosine = 0.0, sine = 0.0;

    double amplitude() const noexcept { return std::hypot(cosine, sine); }
    double at(double seconds) const noexcept {
        return std::exp(-tau * seconds) *
               (cosine * std::cos(omega * seconds) + sine * std::sin(omega * seconds));
    }
    /// The same signal with the time origin `seconds` later.
    Partial shifted(double seconds) const noexcept;
    /// Height of its peak in the magnitude spectrum over a length of `seconds`.
    double spectralPeak(double seconds) const noexcept;
};

/// Standard errors of one partial for white noise of the residual's power (Cramer-Rao bound).
struct PartialError {
    double omega = 0.0, tau = 0.0;
};

/// Samples x[i] at i / rateHz seconds. Message thread (M) only, any number at once.
class PartialFit {
public:
    /// `samples` must outlive the fit.
    PartialFit(std::span<const double> samples, double rateHz);

    /// Adds a partial at the highest spectral peak of the residual, with the decay that removes most energy;
    /// without refinement.
    void addHighest();

    /// Adds a partial as a start value.
    void add(const Partial& partial) { partials_.push_back(partial); }

    /// Fits the amplitudes alone, with fixed frequencies and decays.
    void solveLinear();

    /// Fits all parameters of all partials together. False if nothing improved.
    bool refine();

    const std::vector<Partial>& partials() const noexcept { return partials_; }
    double residualEnergy() const { return energyWith(partials_); }
    PartialError errorOf(std::size_t partial) const;

    static double allowedOmega(double omega, double rateHz) noexcept; ///< limited to what a fit may use
    static double allowedTau(double tau) noexcept;

private:
    NormalEquations equationsOf(const std::vector<Partial>& partials) const;
    std::vector<double> residualOf(const std::vector<Partial>& partials) const;
    double energyWith(const std::vector<Partial>& partials) const;

    std::span<const double> samples_;
    double rateHz_;
    std::vector<Partial> partials_;
};

/// Frequency in Hz of the highest peak in the magnitude spectrum between `lowHz` and `highHz`, to a
/// thousandth of a bin.
double highestPeakHz(std::span<const double> samples, double rateHz, double lowHz, double highHz);

// Recursive exp(-tau t) cos(omega t) and exp(-tau t) sin(omega t), without a library call per sample.

class DecayingPhasor {
public:
    /// The first sample lies at `seconds`.
    DecayingPhasor(double omega, double tau, double rateHz, double seconds = 0.0)
        : turn_{at(omega, tau, 1.0 / rateHz)}
        , now_{at(omega, tau, seconds)} {}
    double cosine() const noexcept { return now_.re; }
    double sine() const noexcept { return now_.im; }
    void next() noexcept { now_ = now_ * turn_; }

private:
    static Complex<double> at(double omega, double tau, double seconds) {
        const double decay = std::exp(-tau * seconds);
        return {decay * std::cos(omega * seconds), decay * std::sin(omega * seconds)};
    }
    Complex<double> turn_, now_;
};

} // namespace physvib
