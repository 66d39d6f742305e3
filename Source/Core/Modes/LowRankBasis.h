// SPDX-License-Identifier: MIT
// Orthonormal polynomials on the 64 frames of a tile (discrete Chebyshev, or Gram, polynomials). Decaying
// sinusoids of low frequency are well approximated by a few of them. Nested: a mode of rank 8 uses the first
// 8 of 32.
#pragma once
#include "Core/Modes/TileLayers.h"

namespace physvib {

/// Polynomial k is even about the middle of the tile for even k, odd for odd k; so half of each is stored.
class LowRankBasis {
public:
    LowRankBasis() noexcept;

    /// [k * 32 + t]: polynomial k at frame t < 32, in the order in which the kernels read it.
    const float* halves() const noexcept { return halves_.data(); }

    /// row[2k], row[2k + 1]: sine and cosine part of p^t along polynomial k < rank. With rank 64: the powers
    /// themselves.
    void project(const double* cosPowers, const double* sinPowers, int rank, float* row) const noexcept;

    /// The smallest of tiles::ranks whose error for this mode is below 2e-7 of its amplitude, rounding to
    /// float included. `radians`: |log p|, by how much the mode turns and decays per frame.
    static int rankFor(double radians) noexcept;

private:
    static constexpr auto half = static_cast<std::size_t>(tiles::frames / 2);
    static constexpr auto most = static_cast<std::size_t>(tiles::maxRank);
    std::array<double, most * half> values_{};
    alignas(64) std::array<float, most * half> halves_{}; // aligned, because kernels load whole vectors
};

} // namespace physvib
