// SPDX-License-Identifier: MIT
// The sounding modes of one tile as a kernel reads them, and the scalar kernel, the reference for the vector
// kernels.
#pragma once
#include "Core/Limits.h"
#include "Core/Trigonometry.h"
#include <array>
#include <cstddef>

namespace physvib {

/// View of a ModeBank for one tile. Mode slot s has limits::tileFrames powers and `channels` amplitudes. Its
/// signal at frame k of the tile in channel j is im(amplitudes[s * channels + j] * p_s^k).
struct ModeTable {
    const int* slots = nullptr; ///< the active slots, in the order in which they are summed
    int count = 0;
    int channels = 0;
    const Complex<double>* amplitudes = nullptr; ///< at the tile's first frame
    const double* cosPowers = nullptr;           ///< re(p_s^k) at [s * limits::tileFrames + k]
    const double* sinPowers = nullptr;           ///< im(p_s^k)
};

/// Writes frames [first, first + frames) of the tile to out[j][0..frames). Each sample depends on its own
/// frame only, so any partition of a tile gives the same bits; it is rounded to float once, at the end.
/// Render thread (R), wait-free.
inline void renderScalar(const ModeTable& table, float* const* out, int first, int frames) noexcept {
    constexpr auto tile = static_cast<std::size_t>(limits::tileFrames);
    for (int j = 0; j < table.channels; ++j) {
        std::array<double, tile> sum{};
        for (int i = 0; i < table.count; ++i) {
            const auto slot = static_cast<std::size_t>(table.slots[i]);
            const auto z = table.amplitudes[slot * static_cast<std::size_t>(table.channels) +
                                            static_cast<std::size_t>(j)];
            const double* c = table.cosPowers + slot * tile + first;
            const double* s = table.sinPowers + slot * tile + first;
            for (int k = 0; k < frames; ++k) sum[static_cast<std::size_t>(k)] += z.re * s[k] + z.im * c[k];
        }
        for (int k = 0; k < frames; ++k) out[j][k] = static_cast<float>(sum[static_cast<std::size_t>(k)]);
    }
}

} // namespace physvib
