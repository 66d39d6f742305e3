// SPDX-License-Identifier: MIT
// Prediction coefficients by least squares; the roots of their polynomial as eigenvalues of its companion
// matrix (Eigen).
#include "Measure/LinearPrediction.h"
#include "Measure/LeastSquares.h"
#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/Polynomials>

namespace physvib {
namespace {

/// Roots of z^n + c[0] z^(n-1) + ... + c[n-1]; none if there are no coefficients.
std::vector<std::complex<double>> rootsOf(std::vector<double> c) {
    if (c.empty()) return {};
    c.insert(c.begin(), 1.0);
    const Eigen::VectorXd rising =
        Eigen::Map<const Eigen::VectorXd>(c.data(), static_cast<Eigen::Index>(c.size())).reverse();
    const auto roots = Eigen::PolynomialSolver<double, Eigen::Dynamic>(rising).roots();
    return {roots.begin(), roots.end()};
}

std::vector<double> meansOf(std::span<const double> samples, std::size_t blocks) {
    const std::size_t length = samples.size() / blocks;
    std::vector<double> means(blocks);
    for (std::size_t b = 0; b < blocks; ++b)
        for (std::size_t i = 0; i < length; ++i)
            means[b] += samples[b * length + i] / static_cast<double>(length);
    return means;
}

/// c with x[n] + c[0] x[n-1] + ... = 0 in the least-squares sense; empty if undetermined.
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

std::vector<PredictedPartial> predictPartials(std::span<const double> samples, double rateHz,
                                              std::size_t partials, std::size_t blocks) {
    std::vector<PredictedPartial> found;
    if (samples.size() < blocks || blocks < 4 * partials) return found;
    const std::size_t blockFrames = samples.size() / blocks; // whole ones
    const double blockRateHz = rateHz / static_cast<double>(blockFrames);
    for (const std::complex<double> root : rootsOf(predictionOf(meansOf(samples, blocks), 2 * partials)))
        if (root.imag() > 1e-6 && std::isfinite(root.real()))
            found.push_back(
                {std::arg(root) * blockRateHz, std::max(-std::log(std::abs(root)) * blockRateHz, 1.0)});
    std::ranges::sort(found, {}, &PredictedPartial::omega);
    return found;
}

} // namespace physvib
