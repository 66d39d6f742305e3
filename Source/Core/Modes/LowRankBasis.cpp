// SPDX-License-Identifier: MIT
// The polynomials by a three-term recurrence with re-orthogonalisation (Stieltjes' procedure). By symmetry
// half a tile suffices.
#include "Core/Modes/LowRankBasis.h"
#include <cmath>

namespace physvib {

LowRankBasis::LowRankBasis() noexcept {
    const auto at = [this](std::size_t k, std::size_t t) -> double& { return values_[k * half + t]; };
    const auto dot = [&](std::size_t a, std::size_t b) { // over the whole tile, for two polynomials of equal
                                                         // symmetry
        double sum = 0;
        for (std::size_t t = 0; t < half; ++t) sum += 2 * at(a, t) * at(b, t);
        return sum;
    };
    for (std::size_t k = 0; k < most; ++k) {
        for (std::size_t t = 0; t < half; ++t) {
            const double x = (2.0 * static_cast<double>(t) - (tiles::frames - 1)) / tiles::frames;
            at(k, t) = k == 0 ? 1.0 : x * at(k - 1, t);
        }
        for (int pass = 0; pass < 2; ++pass)
            for (std::size_t j = k % 2; j < k; j += 2) {
                const double along = dot(k, j);
                for (std::size_t t = 0; t < half; ++t) at(k, t) -= along * at(j, t);
            }
        const double length = std::sqrt(dot(k, k));
        for (std::size_t t = 0; t < half; ++t) at(k, t) /= length;
    }
    for (std::size_t i = 0; i < values_.size(); ++i) halves_[i] = static_cast<float>(values_[i]);
}

void LowRankBasis::project(const double* cosPowers, const double* sinPowers, int rank,
                           float* row) const noexcept {
    constexpr std::size_t frames = 2 * half;
    if (rank == tiles::frames) {
        for (std::size_t t = 0; t < frames; ++t) {
            row[2 * t] = static_cast<float>(sinPowers[t]);
            row[2 * t + 1] = static_cast<float>(cosPowers[t]);
        }
        return;
    }
    std::array<double, 4 * half> folded{}; // even and odd parts of sine and cosine
    for (std::size_t t = 0; t < half; ++t) {
        folded[t] = sinPowers[t] + sinPowers[frames - 1 - t];
        folded[half + t] = cosPowers[t] + cosPowers[frames - 1 - t];
        folded[2 * half + t] = sinPowers[t] - sinPowers[frames - 1 - t];
        folded[3 * half + t] = cosPowers[t] - cosPowers[frames - 1 - t];
    }
    for (std::size_t k = 0; k < static_cast<std::size_t>(rank); ++k) {
        const double* parts = folded.data() + k % 2 * 2 * half;
        double sine = 0, cosine = 0;
        for (std::size_t t = 0; t < half; ++t) {
            sine += values_[k * half + t] * parts[t];
            cosine += values_[k * half + t] * parts[half + t];
        }
        row[2 * k] = static_cast<float>(sine);
        row[2 * k + 1] = static_cast<float>(cosine);
    }
}

int LowRankBasis::rankFor(double radians) noexcept {
    return radians < 0.0275 ? 8 : radians < 0.145 ? 16 : radians < 0.5 ? 32 : 64;
}

} // namespace physvib
