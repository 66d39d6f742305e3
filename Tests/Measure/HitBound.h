// SPDX-License-Identifier: MIT
// What no unbiased estimator gets below: the Cramer-Rao bound of hits of known make in white noise (Kay 1993,
// ch. 3).
#pragma once
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace physvib::test {

struct HitTone {
    double frequencyHz, decayPerSecond, amplitude = 1.0;
};

/// Standard deviations of the first tone's two numbers, as shares of them.
struct HitBound {
    double frequency, decay;
};

/// The inverse's diagonal of a positive matrix (n x n, by rows), by elimination.
inline std::vector<double> inverseDiagonal(std::vector<double> m, std::size_t n) {
    std::vector<double> right(n * n);
    for (std::size_t i = 0; i < n; ++i) right[i * n + i] = 1.0;
    for (std::size_t p = 0; p < n; ++p) {
        const double pivot = m[p * n + p];
        for (std::size_t c = 0; c < n; ++c) m[p * n + c] /= pivot, right[p * n + c] /= pivot;
        for (std::size_t r = 0; r < n; ++r) {
            const double factor = m[r * n + p];
            for (std::size_t c = 0; c < n && r != p; ++c)
                m[r * n + c] -= factor * m[p * n + c], right[r * n + c] -= factor * right[p * n + c];
        }
    }
    std::vector<double> diagonal;
    for (std::size_t i = 0; i < n; ++i) diagonal.push_back(right[i * n + i]);
    return diagonal;
}

/// Tones of Eq. 5.1 that begin together at a moment that nobody tells, seen for `seconds` after it; noise of
/// standard deviation `noise` per sample. Derivatives are taken in shares of each number, so that the matrix
/// keeps its digits.
inline HitBound boundOf(const std::vector<HitTone>& tones, double noise, double rateHz, double seconds) {
    const std::size_t n = 1 + 3 * tones.size();
    std::vector<double> information(n * n), row(n);
    for (double t = 0.5 / rateHz; t < seconds; t += 1.0 / rateHz) {
        row[0] = 0.0;
        for (std::size_t k = 0; k < tones.size(); ++k) {
            const auto& [hz, tau, amplitude] = tones[k];
            const double omega = 2.0 * std::numbers::pi * hz, e = amplitude * std::exp(-tau * t),
                         c = e * std::cos(omega * t), s = e * std::sin(omega * t);
            row[0] += (tau * s - omega * c) / tones.front().decayPerSecond;
            row[1 + 3 * k] = omega * t * c;
            row[2 + 3 * k] = -tau * t * s;
            row[3 + 3 * k] = s;
        }
        for (std::size_t a = 0; a < n; ++a)
            for (std::size_t b = 0; b < n; ++b) information[a * n + b] += row[a] * row[b];
    }
    const std::vector<double> variance = inverseDiagonal(std::move(information), n);
    return {noise * std::sqrt(variance[1]), noise * std::sqrt(variance[2])};
}

} // namespace physvib::test
