// SPDX-License-Identifier: MIT
// Least squares of a sum of decaying sinusoids to samples, partials found one by one and refined together.
#pragma once
#include "Measure/HitExcerpt.h"
#include "Measure/LeastSquares.h"
#include <cmath>
#include <span>
#include <vector>

namespace physvib {

/// exp(-tau t) (cosine cos(omega t) + sine sin(omega t)), t = seconds since the first sample that was fitted.
struct Partial {
    double omega = 0.0; ///< rad/s
    double tau = 0.0;   ///< 1/s
    double cosine = 0.0, sine = 0.0;

    double amplitude() const noexcept { return std::hypot(cosine, sine); }
    double at(double seconds) const noexcept {
        return std::exp(-tau * seconds) *
               (cosine * std::cos(omega * seconds) + sine * std::sin(omega * seconds));
    }
    /// The same sound, told from a first sample that is `seconds` later.
    Partial shifted(double seconds) const noexcept;
    /// Height of its peak in the magnitude spectrum of `seconds` of it.
    double spectralPeak(double seconds) const noexcept;
};

/// Standard errors of one partial, as white noise of the residual's power would make them (Cramer-Rao bound).
struct PartialError {
    double omega = 0.0, tau = 0.0;
};

/// Samples x[i] at i / rateHz seconds. M only, any number at once.
class PartialFit {
public:
    /// `samples` outlive the fit.
    PartialFit(std::span<const double> samples, double rateHz);

    /// Adds the partial under the highest peak of what is left, where it takes most of it away; not refined
    /// yet.
    void addHighest();

    /// Takes a partial as a start.
    void add(const Partial& partial) { partials_.push_back(partial); }

    /// The amplitudes alone, at the frequencies and decays as they are.
    void solveLinear();

    /// All numbers of all partials together. False if there was nothing to gain.
    bool refine();

    const std::vector<Partial>& partials() const noexcept { return partials_; }
    double residualEnergy() const { return energyWith(partials_); }
    PartialError errorOf(std::size_t partial) const;

    static double allowedOmega(double omega, double rateHz) noexcept; ///< the nearest that a fit may take
    static double allowedTau(double tau) noexcept;

private:
    NormalEquations equationsOf(const std::vector<Partial>& partials) const;
    std::vector<double> residualOf(const std::vector<Partial>& partials) const;
    double energyWith(const std::vector<Partial>& partials) const;

    std::span<const double> samples_;
    double rateHz_;
    std::vector<Partial> partials_;
};

/// Frequency in Hz, between `lowHz` and `highHz`, of the highest peak in the magnitude spectrum, to a
/// thousandth of a bin.
double highestPeakHz(std::span<const double> samples, double rateHz, double lowHz, double highHz);

} // namespace physvib
