// SPDX-License-Identifier: MIT
// Levenberg-Marquardt least squares, and the fit of a sum of decaying sinusoids (partials) to samples.
#pragma once
#include "Core/Trigonometry.h"
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {

/// Equations of damped nonlinear least squares (Levenberg 1944, Marquardt 1963): the sums J^T J and J^T r of
/// a model's derivatives J and its residual r over the samples. Message thread (M) only (allocates).
class NormalEquations {
public:
    static constexpr std::size_t blockRows = 256; ///< rows per call, contiguous in memory for fast products
    using Column = std::array<double, blockRows>;

    explicit NormalEquations(std::size_t size);

    /// Adds as many rows as `residuals` has, at most `blockRows`: the residual, and its derivative by each
    /// parameter.
    void add(const std::vector<Column>& columns, std::span<const double> residuals);

    /// The step with damping `lambda`; empty if the equations are singular.
    std::vector<double> step(double lambda) const;

    /// The equations of only the parameters `first`, `first + stride`, ... (`width` of each): those in which
    /// the model is linear.
    NormalEquations subset(std::size_t first, std::size_t stride, std::size_t width) const;

    /// Standard error of a parameter under white noise of `variance` (Cramer-Rao bound); infinite if it is
    /// undetermined.
    double stdError(std::size_t parameter, double variance) const;

    std::size_t size() const noexcept { return rightSide_.size(); }

private:
    std::vector<double> matrix_, rightSide_; // row by row; only the lower triangle is used
};

/// Improves `model` until the energy no longer falls; false if no step lowered it. `computeEnergy(model)` is
/// minimised, `makeEquations(model)` returns its NormalEquations, `takeStep(model, step)` the model after a
/// step.
template <class Model, class Energy, class Equations, class Step>
bool minimise(Model& model, Energy computeEnergy, Equations makeEquations, Step takeStep) {
    constexpr int maxSteps = 40;
    constexpr double minRelativeGain = 1e-12; // relative gain of a step that ends the search
    double energy = computeEnergy(model), lambda = 1e-3;
    NormalEquations equations = makeEquations(model);
    bool hasMoved = false;
    for (int i = 0; i < maxSteps && lambda < 1e9; ++i) {
        const std::vector<double> step = equations.step(lambda);
        Model trial = step.empty() ? model : takeStep(model, step);
        const double newEnergy = step.empty() ? energy : computeEnergy(trial);
        if (!(newEnergy < energy)) {
            lambda *= 10.0;
            continue;
        }
        const bool hasConverged = energy - newEnergy < minRelativeGain * energy;
        model = std::move(trial);
        energy = newEnergy;
        hasMoved = true;
        if (hasConverged) break;
        lambda *= 0.1;
        equations = makeEquations(model);
    }
    return hasMoved;
}

/// exp(-tau t) (cosine cos(omega t) + sine sin(omega t)), t = seconds since the first fitted sample.
struct Partial {
    double omega = 0.0; ///< rad/s
    double tau = 0.0;   ///< 1/s
    double cosine = 0.0, sine = 0.0;

    double amplitude() const noexcept { return std::hypot(cosine, sine); }
    double value(double seconds) const noexcept {
        return std::exp(-tau * seconds) *
               (cosine * std::cos(omega * seconds) + sine * std::sin(omega * seconds));
    }
    /// The same signal with the time origin `seconds` later.
    Partial shifted(double seconds) const noexcept {
        const double decay = std::exp(-tau * seconds), c = decay * std::cos(omega * seconds),
                     s = decay * std::sin(omega * seconds);
        return {omega, tau, cosine * c + sine * s, sine * c - cosine * s};
    }
    /// Height of its peak in the magnitude spectrum over a length of `seconds`.
    double spectralPeak(double seconds) const noexcept {
        return amplitude() * -std::expm1(-tau * seconds) / (2.0 * tau);
    }
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
    void addHighestPeak();

    /// Adds a partial as a start value.
    void add(const Partial& partial) { partials_.push_back(partial); }

    /// Fits the amplitudes alone, with fixed frequencies and decays.
    void solveLinear();

    /// Fits all parameters of all partials together. False if nothing improved.
    bool refine();

    const std::vector<Partial>& partials() const noexcept { return partials_; }
    double residualEnergy() const { return residualEnergy(partials_); }
    PartialError stdError(std::size_t partial) const;

    static double clampedOmega(double omega, double rateHz) noexcept; ///< limited to what a fit may use
    static double clampedTau(double tau) noexcept;

private:
    NormalEquations makeEquations(const std::vector<Partial>& partials) const;
    std::vector<double> residual(const std::vector<Partial>& partials) const;
    double residualEnergy(const std::vector<Partial>& partials) const;

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
        : rotation_{phasorAt(omega, tau, 1.0 / rateHz)}
        , current_{phasorAt(omega, tau, seconds)} {}
    double cosine() const noexcept { return current_.re; }
    double sine() const noexcept { return current_.im; }
    void next() noexcept { current_ = current_ * rotation_; }

private:
    static Complex<double> phasorAt(double omega, double tau, double seconds) {
        const double decay = std::exp(-tau * seconds);
        return {decay * std::cos(omega * seconds), decay * std::sin(omega * seconds)};
    }
    Complex<double> rotation_, current_;
};

} // namespace physvib
