// SPDX-License-Identifier: MIT
// Orthonormal polynomials on the 64 frames of a tile (discrete Chebyshev, or Gram, polynomials): the few
// directions in which decaying sinusoids of low frequency lie. Nested: a mode of rank 8 uses the first 8
// of 32.
#pragma once
#include "Core/Modes/TileLayers.h"

namespace physvib {

/// Polynomial k is even about the middle of the tile for even k, odd for odd k; so half of each says all.
class LowRankBasis {
public:
    LowRankBasis() noexcept;

    /// [k * 32 + t]: polynomial k at frame t < 32, as the expansion reads it.
    const float* halves() const noexcept { return halves_.data(); }

    /// row[2k], row[2k + 1]: sine and cosine part of p^t along polynomial k < rank. rank 64: the powers
    /// themselves.
    void project(const double* cosPowers, const double* sinPowers, int rank, float* row) const noexcept;

    /// Least of tiles::ranks whose error for this mode is below 2e-7 of its amplitude, rounding to float
    /// included. `radians`: |log p|, how far the mode turns and decays in a frame.
    static int rankFor(double radians) noexcept;

private:
    static constexpr auto half = static_cast<std::size_t>(tiles::frames / 2);
    static constexpr auto most = static_cast<std::size_t>(tiles::maxRank);
    std::array<double, most * half> values_{};
    alignas(64) std::array<float, most * half> halves_{}; // kernels load whole vectors
};

} // namespace physvib
