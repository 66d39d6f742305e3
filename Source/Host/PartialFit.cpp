// SPDX-License-Identifier: GPL-3.0-or-later
// Start values from the residual's spectrum and matched filters; then all four numbers of every partial at once
// (Levenberg 1944, Marquardt 1963).
#include "Host/PartialFit.h"
#include "Host/Spectrum.h"
#include <algorithm>
#include <array>
#include <numbers>

namespace physvib {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double lowestHz = 10.0;     // below: drift, not vibration
constexpr double leastTau = 0.01, mostTau = 5000.0; // a hum; a click
constexpr int mostSteps = 40;
constexpr double enough = 1e-12;      // relative gain of a step that ends the search

/// Numbers of one partial in the order in which they stand in the equations.
constexpr std::size_t numbersEach = 4;

/// Visits exp(-tau t) cos and sin of omega t, sample by sample, without a library call each.
class Phasor {
public:
    Phasor(const Partial& p, double rateHz)
        : turn_{std::exp(-p.tau / rateHz) * std::cos(p.omega / rateHz), std::exp(-p.tau / rateHz) * std::sin(p.omega / rateHz)} {}
    double cosine() const noexcept { return now_.re; }
    double sine() const noexcept { return now_.im; }
    void next() noexcept { now_ = now_ * turn_; }

private:
    Complex<double> turn_, now_{1.0, 0.0};
};

void subtract(std::vector<double>& samples, const Partial& p, double rateHz) {
    Phasor phasor{p, rateHz};
    for (double& x : samples) {
        x -= p.cosine * phasor.cosine() + p.sine * phasor.sine();
        phasor.next();
    }
}

double energyOf(std::span<const double> samples) {
    double sum = 0.0;
    for (const double x : samples) sum += x * x;
    return sum;
}

/// The amplitudes that fit best at p's frequency and decay; the energy that this takes away.
double solveAmplitudes(std::span<const double> samples, double rateHz, Partial& p) {
    const Complex<double> point = pointOfSpectrum(samples, rateHz, p.omega, p.tau);
    double cc = 0.0, ss = 0.0, cs = 0.0;
    Phasor phasor{p, rateHz};
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

/// Cholesky; false if `a` (n x n, by rows) is not positive. `b` becomes the solution.
bool solve(std::vector<double> a, std::vector<double>& b) {
    const std::size_t n = b.size();
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
            double sum = a[i * n + j];
            for (std::size_t k = 0; k < j; ++k) sum -= a[i * n + k] * a[j * n + k];
            if (i == j && !(sum > 0.0)) return false;
            a[i * n + j] = i == j ? std::sqrt(sum) : sum / a[j * n + j];
        }
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
        b[i] /= a[i * n + i];
    }
    for (std::size_t i = n; i-- > 0;) {
        for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
        b[i] /= a[i * n + i];
    }
    return true;
}

} // namespace

Partial Partial::shifted(double seconds) const noexcept {
    const double decay = std::exp(-tau * seconds), c = decay * std::cos(omega * seconds), s = decay * std::sin(omega * seconds);
    return {omega, tau, cosine * c + sine * s, sine * c - cosine * s};
}

double Partial::spectralPeak(double seconds) const noexcept { return amplitude() * -std::expm1(-tau * seconds) / (2.0 * tau); }

PartialFit::PartialFit(std::span<const double> samples, double rateHz)
    : samples_{samples}
    , rateHz_{rateHz} {}

struct PartialFit::Normal {
    std::size_t size;
    std::vector<double> matrix, right;

    /// The step that a damping of `lambda` gives; empty if there is none.
    std::vector<double> step(double lambda) const {
        std::vector<double> damped = matrix, b = right;
        for (std::size_t i = 0; i < size; ++i) damped[i * size + i] *= 1.0 + lambda;
        return solve(std::move(damped), b) ? b : std::vector<double>{};
    }
};

// Rows come in blocks, column by column, so that the products run over neighbours.
PartialFit::Normal PartialFit::normalEquations() const {
    constexpr std::size_t block = 256;
    const std::size_t size = numbersEach * partials_.size();
    Normal normal{size, std::vector<double>(size * size), std::vector<double>(size)};
    const std::vector<double> rest = residual();
    std::vector<Phasor> phasors;
    for (const Partial& p : partials_) phasors.emplace_back(p, rateHz_);
    std::vector<std::array<double, block>> columns(size);
    for (std::size_t first = 0; first < rest.size(); first += block) {
        const std::size_t count = std::min(block, rest.size() - first);
        for (std::size_t k = 0; k < partials_.size(); ++k)
            for (std::size_t i = 0; i < count; ++i, phasors[k].next()) {
                const Partial& p = partials_[k];
                const double t = static_cast<double>(first + i) / rateHz_, c = phasors[k].cosine(), s = phasors[k].sine();
                columns[numbersEach * k][i] = c;
                columns[numbersEach * k + 1][i] = s;
                columns[numbersEach * k + 2][i] = t * (p.sine * c - p.cosine * s);
                columns[numbersEach * k + 3][i] = -t * (p.cosine * c + p.sine * s);
            }
        for (std::size_t a = 0; a < size; ++a) {
            for (std::size_t b = 0; b <= a; ++b)
                for (std::size_t i = 0; i < count; ++i) normal.matrix[a * size + b] += columns[a][i] * columns[b][i];
            for (std::size_t i = 0; i < count; ++i) normal.right[a] += columns[a][i] * rest[first + i];
        }
    }
    return normal;
}

std::vector<double> PartialFit::residual() const {
    std::vector<double> rest(samples_.begin(), samples_.end());
    for (const Partial& p : partials_) subtract(rest, p, rateHz_);
    return rest;
}

double PartialFit::residualEnergy() const { return energyOf(residual()); }

double PartialFit::energyWith(const std::vector<Partial>& partials) const {
    std::vector<double> rest(samples_.begin(), samples_.end());
    for (const Partial& p : partials) subtract(rest, p, rateHz_);
    return energyOf(rest);
}

// The spectrum of a decaying sine peaks at omega_p^2 = omega^2 - tau^2: below its frequency.
void PartialFit::addHighest() {
    const std::vector<double> rest = residual();
    const double peak = 2.0 * pi * highestPeakHz(rest, rateHz_, lowestHz, 0.5 * rateHz_);
    Partial best;
    double most = -1.0;
    for (double tau = 2.0; tau < 2000.0; tau *= 1.6)
        for (const double omega : {peak, std::hypot(peak, tau)}) {
            Partial p{std::min(omega, pi * rateHz_), tau, 0.0, 0.0};
            if (const double taken = solveAmplitudes(rest, rateHz_, p); taken > most) {
                most = taken;
                best = p;
            }
        }
    partials_.push_back(best);
}

void PartialFit::solveLinear() { solveAmplitudes(samples_, rateHz_, partials_.front()); }

bool PartialFit::refine() {
    double energy = energyWith(partials_), lambda = 1e-3;
    Normal normal = normalEquations();
    bool moved = false;
    for (int i = 0; i < mostSteps && lambda < 1e9; ++i) {
        const std::vector<double> step = normal.step(lambda);
        std::vector<Partial> trial = partials_;
        for (std::size_t k = 0; k < trial.size() && !step.empty(); ++k) {
            const double* const by = &step[numbersEach * k];
            Partial& p = trial[k];
            p = {std::clamp(p.omega + by[2], 2.0 * pi * lowestHz, pi * rateHz_), std::clamp(p.tau + by[3], leastTau, mostTau), p.cosine + by[0], p.sine + by[1]};
        }
        const double found = step.empty() ? energy : energyWith(trial);
        if (!(found < energy)) {
            lambda *= 10.0;
            continue;
        }
        const bool isEnough = energy - found < enough * energy;
        partials_ = std::move(trial);
        energy = found;
        moved = true;
        if (isEnough) break;
        lambda *= 0.1;
        normal = normalEquations();
    }
    return moved;
}

PartialError PartialFit::errorOf(std::size_t partial) const {
    const Normal normal = normalEquations();
    if (samples_.size() <= normal.size) return {HUGE_VAL, HUGE_VAL};
    const double variance = residualEnergy() / static_cast<double>(samples_.size() - normal.size);
    const auto error = [&](std::size_t at) {
        std::vector<double> unit(normal.size);
        unit[at] = 1.0;
        return solve(normal.matrix, unit) ? std::sqrt(variance * unit[at]) : HUGE_VAL;
    };
    return {error(numbersEach * partial + 2), error(numbersEach * partial + 3)};
}

double highestPeakHz(std::span<const double> samples, double rateHz, double lowHz, double highHz) {
    const std::vector<double> all = magnitudes(samples);
    const double binHz = 0.5 * rateHz / static_cast<double>(all.size() - 1);
    const auto bin = [&](double hz) { return std::clamp<std::ptrdiff_t>(std::lround(hz / binHz), 1, static_cast<std::ptrdiff_t>(all.size()) - 2); };
    const auto highest = std::max_element(all.begin() + bin(lowHz), all.begin() + bin(highHz) + 1) - all.begin();
    double low = static_cast<double>(highest - 1) * binHz, high = static_cast<double>(highest + 1) * binHz;
    const auto height = [&](double hz) {
        const auto point = pointOfSpectrum(samples, rateHz, 2.0 * pi * hz, 0.0);
        return std::hypot(point.re, point.im);
    };
    while (high - low > 1e-3 * binHz) { // one maximum between neighbours of the highest bin
        const double third = (high - low) / 3.0;
        if (height(low + third) < height(high - third)) low += third;
        else high -= third;
    }
    return std::clamp(0.5 * (low + high), lowHz, highHz);
}

} // namespace physvib
