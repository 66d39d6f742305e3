// SPDX-License-Identifier: MIT
// Start values from the residual's spectrum and matched filters, then a joint fit of the four parameters of
// every partial.
#include "Measure/PartialFit.h"
#include "Measure/HitExcerpt.h"
#include "Measure/Spectrum.h"
#include <Eigen/Cholesky>
#include <algorithm>
#include <numbers>

namespace physvib {

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using Rows = Eigen::Map<const Eigen::MatrixXd, Eigen::Unaligned, Eigen::OuterStride<>>;

/// Solves a x = b from the lower triangle of `a`; false if it is not positive definite.
bool solve(const Matrix& a, Eigen::Ref<Eigen::VectorXd> b) {
    const Eigen::LLT<Matrix> cholesky(a);
    if (cholesky.info() != Eigen::Success) return false;
    cholesky.solveInPlace(b);
    return true;
}

Eigen::Index index(std::size_t i) noexcept { return static_cast<Eigen::Index>(i); }

Matrix square(const std::vector<double>& byRows, std::size_t size) {
    return Eigen::Map<const Matrix>(byRows.data(), index(size), index(size));
}
Eigen::Map<Eigen::VectorXd> asVector(std::vector<double>& numbers) {
    return {numbers.data(), index(numbers.size())};
}

} // namespace

NormalEquations::NormalEquations(std::size_t size)
    : matrix_(size * size)
    , rightSide_(size) {}

void NormalEquations::add(const std::vector<Column>& columns, std::span<const double> residuals) {
    const Rows derivatives(columns.front().data(), index(residuals.size()), index(size()),
                           Eigen::OuterStride<>(index(blockRows)));
    Eigen::Map<Matrix> matrix(matrix_.data(), index(size()), index(size()));
    matrix.triangularView<Eigen::Lower>() += derivatives.transpose() * derivatives;
    asVector(rightSide_) += derivatives.transpose() *
                            Eigen::Map<const Eigen::VectorXd>(residuals.data(), index(residuals.size()));
}

std::vector<double> NormalEquations::step(double lambda) const {
    Matrix damped = square(matrix_, size());
    damped.diagonal() *= 1.0 + lambda;
    std::vector<double> b = rightSide_;
    return solve(damped, asVector(b)) ? b : std::vector<double>{};
}

NormalEquations NormalEquations::subset(std::size_t first, std::size_t stride, std::size_t width) const {
    std::vector<std::size_t> indices;
    for (std::size_t group = first; group < size(); group += stride)
        for (std::size_t i = 0; i < width; ++i) indices.push_back(group + i);
    NormalEquations part(indices.size());
    for (std::size_t a = 0; a < indices.size(); ++a) {
        for (std::size_t b = 0; b <= a; ++b)
            part.matrix_[a * indices.size() + b] = matrix_[indices[a] * size() + indices[b]];
        part.rightSide_[a] = rightSide_[indices[a]];
    }
    return part;
}

double NormalEquations::stdError(std::size_t parameter, double variance) const {
    std::vector<double> unit(size());
    unit[parameter] = 1.0;
    return solve(square(matrix_, size()), asVector(unit)) ? std::sqrt(variance * unit[parameter]) : HUGE_VAL;
}

namespace {

constexpr double pi = std::numbers::pi;
constexpr double minHz = 10.0;                   // lower frequencies are drift, not vibration
constexpr double minTau = 0.01, maxTau = 5000.0; // bounds: hum, click

/// Parameters per partial, in the order of the equations.
constexpr std::size_t parametersPerPartial = 4;

void subtract(std::vector<double>& samples, const Partial& p, double rateHz) {
    DecayingPhasor phasor{p.omega, p.tau, rateHz};
    for (double& x : samples) {
        x -= p.cosine * phasor.cosine() + p.sine * phasor.sine();
        phasor.next();
    }
}

/// Sets the best amplitudes at p's frequency and decay; returns the energy that this removes.
double solveAmplitudes(std::span<const double> samples, double rateHz, Partial& p) {
    const Complex<double> point = spectrumValue(samples, rateHz, p.omega, p.tau);
    double cc = 0.0, ss = 0.0, cs = 0.0;
    DecayingPhasor phasor{p.omega, p.tau, rateHz};
    for (std::size_t i = 0; i < samples.size(); ++i, phasor.next()) {
        cc += phasor.cosine() * phasor.cosine();
        ss += phasor.sine() * phasor.sine();
        cs += phasor.cosine() * phasor.sine();
    }
    const double c = point.re, s = -point.im, determinant = cc * ss - cs * cs;
    if (!(determinant > 1e-12 * cc * ss)) return 0.0;
    p.cosine = (c * ss - s * cs) / determinant;
    p.sine = (s * cc - c * cs) / determinant;
    return p.cosine * c + p.sine * s;
}

} // namespace

PartialFit::PartialFit(std::span<const double> samples, double rateHz)
    : samples_{samples}
    , rateHz_{rateHz} {}

NormalEquations PartialFit::makeEquations(const std::vector<Partial>& partials) const {
    NormalEquations equations(parametersPerPartial * partials.size());
    const std::vector<double> residuals = residual(partials);
    std::vector<DecayingPhasor> phasors;
    for (const Partial& p : partials) phasors.emplace_back(p.omega, p.tau, rateHz_);
    std::vector<NormalEquations::Column> columns(equations.size());
    for (std::size_t first = 0; first < residuals.size(); first += NormalEquations::blockRows) {
        const std::size_t count = std::min(NormalEquations::blockRows, residuals.size() - first);
        for (std::size_t k = 0; k < partials.size(); ++k)
            for (std::size_t i = 0; i < count; ++i, phasors[k].next()) {
                const Partial& p = partials[k];
                const double t = static_cast<double>(first + i) / rateHz_, c = phasors[k].cosine(),
                             s = phasors[k].sine();
                columns[parametersPerPartial * k][i] = c;
                columns[parametersPerPartial * k + 1][i] = s;
                columns[parametersPerPartial * k + 2][i] = t * (p.sine * c - p.cosine * s);
                columns[parametersPerPartial * k + 3][i] = -t * (p.cosine * c + p.sine * s);
            }
        equations.add(columns, std::span(residuals).subspan(first, count));
    }
    return equations;
}

std::vector<double> PartialFit::residual(const std::vector<Partial>& partials) const {
    std::vector<double> residuals(samples_.begin(), samples_.end());
    for (const Partial& p : partials) subtract(residuals, p, rateHz_);
    return residuals;
}

double PartialFit::residualEnergy(const std::vector<Partial>& partials) const {
    return signalEnergy(residual(partials));
}

// The spectrum of a decaying sine peaks at omega_p^2 = omega^2 - tau^2, below its frequency.
void PartialFit::addHighestPeak() {
    const std::vector<double> residuals = residual(partials_);
    const double peak = 2.0 * pi * highestPeakHz(residuals, rateHz_, minHz, 0.5 * rateHz_);
    Partial best;
    double maxRemoved = -1.0;
    for (double tau = 2.0; tau < 2000.0; tau *= 1.6)
        for (const double omega : {peak, std::hypot(peak, tau)}) {
            Partial p{std::min(omega, pi * rateHz_), tau, 0.0, 0.0};
            if (const double removed = solveAmplitudes(residuals, rateHz_, p); removed > maxRemoved) {
                maxRemoved = removed;
                best = p;
            }
        }
    partials_.push_back(best);
}

void PartialFit::solveLinear() {
    for (Partial& p : partials_) p.cosine = p.sine = 0.0;
    const std::vector<double> amplitudes =
        makeEquations(partials_).subset(0, parametersPerPartial, 2).step(1e-12);
    for (std::size_t k = 0; k < partials_.size() && !amplitudes.empty(); ++k)
        partials_[k].cosine = amplitudes[2 * k], partials_[k].sine = amplitudes[2 * k + 1];
}

double PartialFit::clampedOmega(double omega, double rateHz) noexcept {
    return std::clamp(omega, 2.0 * pi * minHz, pi * rateHz);
}
double PartialFit::clampedTau(double tau) noexcept { return std::clamp(tau, minTau, maxTau); }

bool PartialFit::refine() {
    const auto takeStep = [this](std::vector<Partial> partials, const std::vector<double>& step) {
        for (std::size_t k = 0; k < partials.size(); ++k) {
            const double* const change = &step[parametersPerPartial * k];
            Partial& p = partials[k];
            p = {clampedOmega(p.omega + change[2], rateHz_), clampedTau(p.tau + change[3]),
                 p.cosine + change[0], p.sine + change[1]};
        }
        return partials;
    };
    return minimise(
        partials_, [this](const auto& partials) { return residualEnergy(partials); },
        [this](const auto& partials) { return makeEquations(partials); }, takeStep);
}

PartialError PartialFit::stdError(std::size_t partial) const {
    const NormalEquations equations = makeEquations(partials_);
    if (samples_.size() <= equations.size()) return {HUGE_VAL, HUGE_VAL};
    const double variance = residualEnergy() / static_cast<double>(samples_.size() - equations.size());
    return {equations.stdError(parametersPerPartial * partial + 2, variance),
            equations.stdError(parametersPerPartial * partial + 3, variance)};
}

double highestPeakHz(std::span<const double> samples, double rateHz, double lowHz, double highHz) {
    const std::vector<double> all = magnitudes(samples);
    const double binHz = 0.5 * rateHz / static_cast<double>(all.size() - 1);
    const auto bin = [&](double hz) {
        return std::clamp<std::ptrdiff_t>(std::lround(hz / binHz), 1,
                                          static_cast<std::ptrdiff_t>(all.size()) - 2);
    };
    const auto highestBin =
        std::max_element(all.begin() + bin(lowHz), all.begin() + bin(highHz) + 1) - all.begin();
    double low = static_cast<double>(highestBin - 1) * binHz,
           high = static_cast<double>(highestBin + 1) * binHz;
    const auto magnitudeAt = [&](double hz) {
        const auto point = spectrumValue(samples, rateHz, 2.0 * pi * hz, 0.0);
        return std::hypot(point.re, point.im);
    };
    while (high - low > 1e-3 * binHz) { // ternary search between the neighbours of the highest bin
        const double third = (high - low) / 3.0;
        if (magnitudeAt(low + third) < magnitudeAt(high - third))
            low += third;
        else
            high -= third;
    }
    return std::clamp(0.5 * (low + high), lowHz, highHz);
}

} // namespace physvib
