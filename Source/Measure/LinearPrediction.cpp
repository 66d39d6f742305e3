// SPDX-License-Identifier: MIT
// Coefficients by least squares, their polynomial's roots all at once (Durand 1960, Kerner 1966).
#include "Measure/LinearPrediction.h"
#include "Measure/LeastSquares.h"
#include <algorithm>
#include <cmath>
#include <complex>

namespace physvib {
namespace {

using Complex = std::complex<double>;

/// Roots of z^n + c[0] z^(n-1) + ... + c[n-1].
std::vector<Complex> rootsOf(const std::vector<double>& c) {
    std::vector<Complex> roots;
    for (std::size_t k = 0; k < c.size(); ++k) roots.push_back(std::pow(Complex{0.4, 0.9}, static_cast<double>(k)));
    for (int round = 0; round < 200; ++round)
        for (std::size_t k = 0; k < roots.size(); ++k) {
            Complex value = 1.0, others = 1.0;
            for (const double factor : c) value = value * roots[k] + factor;
            for (std::size_t j = 0; j < roots.size(); ++j)
                if (j != k) others *= roots[k] - roots[j];
            roots[k] -= value / others;
        }
    return roots;
}

std::vector<double> meansOf(std::span<const double> samples, std::size_t blocks) {
    const std::size_t length = samples.size() / blocks;
    std::vector<double> means(blocks);
    for (std::size_t b = 0; b < blocks; ++b)
        for (std::size_t i = 0; i < length; ++i) means[b] += samples[b * length + i] / static_cast<double>(length);
    return means;
}

/// c with x[n] + c[0] x[n-1] + ... = 0 as nearly as can be; empty if the samples do not tell.
std::vector<double> predictionOf(const std::vector<double>& x, std::size_t order) {
    NormalEquations equations(order);
    std::vector<NormalEquations::Column> columns(order);
    for (std::size_t n = order; n < x.size(); ++n) {
        for (std::size_t j = 0; j < order; ++j) columns[j][0] = -x[n - 1 - j];
        equations.add(columns, std::span(&x[n], 1));
    }
    return equations.step(1e-14);
}

} // namespace

std::vector<PredictedPartial> predictPartials(std::span<const double> samples, double rateHz, std::size_t partials, std::size_t blocks) {
    std::vector<PredictedPartial> found;
    if (samples.size() < blocks || blocks < 4 * partials) return found;
    const double blockRateHz = rateHz / static_cast<double>(samples.size() / blocks);
    for (const Complex root : rootsOf(predictionOf(meansOf(samples, blocks), 2 * partials)))
        if (root.imag() > 1e-6 && std::isfinite(root.real()))
            found.push_back({std::arg(root) * blockRateHz, std::max(-std::log(std::abs(root)) * blockRateHz, 1.0)});
    std::ranges::sort(found, {}, &PredictedPartial::omega);
    return found;
}

} // namespace physvib
