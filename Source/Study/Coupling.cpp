// SPDX-License-Identifier: MIT
// Regularised least squares over complex amplitudes.
#include "Study/Coupling.h"
#include <algorithm>
#include <cmath>

namespace physvib {
namespace {

using Complex = std::complex<double>;

double strongest(const ComplexAmplitudes& amplitudes) {
    double most = 0.0;
    for (const Complex& a : amplitudes) most = std::max(most, std::abs(a));
    return most;
}

/// (C^H C + lambda) d = C^H a, by elimination: the matrix is positive definite for lambda > 0.
ComplexAmplitudes solve(const CouplingMatrix& c, const ComplexAmplitudes& wanted, double lambda) {
    const std::size_t n = c.size;
    std::vector<Complex> m(n * (n + 1));
    const auto at = [&m, n](std::size_t i, std::size_t j) -> Complex& { return m[i * (n + 1) + j]; };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t j = 0; j < n; ++j) at(i, j) += std::conj(c.at(k, i)) * c.at(k, j);
            at(i, n) += std::conj(c.at(k, i)) * wanted[k];
        }
    for (std::size_t i = 0; i < n; ++i) at(i, i) += lambda;
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t r = i + 1; r < n; ++r) {
            const Complex factor = at(r, i) / at(i, i);
            for (std::size_t j = i; j <= n; ++j) at(r, j) -= factor * at(i, j);
        }
    ComplexAmplitudes drives(n);
    for (std::size_t i = n; i-- > 0;) {
        Complex sum = at(i, n);
        for (std::size_t j = i + 1; j < n; ++j) sum -= at(i, j) * drives[j];
        drives[i] = sum / at(i, i);
    }
    return drives;
}

} // namespace

ComplexAmplitudes CouplingMatrix::felt(const ComplexAmplitudes& drives) const {
    ComplexAmplitudes sums(size);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) sums[i] += at(i, j) * drives[j];
    return sums;
}

ComplexAmplitudes compensated(const CouplingMatrix& coupling, const ComplexAmplitudes& wanted, double mostDecibels) {
    constexpr double least = 1e-9, most = 1e3; // of full scale squared: nothing, and a drive that is nearly none
    const double limit = std::pow(10.0, mostDecibels / 20.0) * strongest(wanted);
    ComplexAmplitudes drives = solve(coupling, wanted, least);
    if (strongest(drives) <= limit) return drives;
    double low = std::log(least), high = std::log(most); // the drive falls with lambda
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        drives = solve(coupling, wanted, std::exp(middle));
        (strongest(drives) > limit ? low : high) = middle;
    }
    return solve(coupling, wanted, std::exp(high));
}

std::vector<double> attenuationRatios(std::span<const double> isolated, std::span<const double> reference) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(isolated.size(), reference.size()); ++i) ratios.push_back(1.0 - isolated[i] / reference[i]);
    return ratios;
}

double combinedAttenuation(std::span<const double> ratios) {
    double sum = 0.0;
    for (const double ratio : ratios) sum += ratio * ratio;
    return std::sqrt(sum);
}

} // namespace physvib
