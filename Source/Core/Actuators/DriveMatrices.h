// SPDX-License-Identifier: MIT
// Compensation of mechanical coupling between actuators: complex drive matrices per frequency, which make
// coupled actuators together vibrate as one alone would. Lab/Study/Coupling.h computes them; the caller owns
// the memory.
#pragma once
#include "Core/Trigonometry.h"
#include <algorithm>
#include <cstddef>
#include <span>

namespace physvib {

/// `entries[k][i * channels + j]`: drive of channel i for a gain of 1 of channel j at frequencies[k]. Both
/// lists must outlive this object. Empty: drives are the gains.
struct DriveMatrices {
    std::span<const double> frequenciesHz;    ///< rising
    std::span<const Complex<double>> entries; ///< matrix by matrix, row by row
    std::size_t channels = 0;

    bool isOn() const noexcept { return !frequenciesHz.empty(); }

    /// The drives in phase with the strike, and those a quarter turn ahead. Linear interpolation between
    /// frequencies; beyond them the nearest matrix. A list holds `channels` numbers. Any thread, wait-free.
    void apply(double frequencyHz, const double* gains, double* inPhase, double* quadrature) const noexcept {
        const auto upper = static_cast<std::size_t>(std::ranges::lower_bound(frequenciesHz, frequencyHz) -
                                                    frequenciesHz.begin());
        const std::size_t high = std::min(upper, frequenciesHz.size() - 1), low = upper == 0 ? 0 : upper - 1;
        const double step = frequenciesHz[high] - frequenciesHz[low];
        const double share = step > 0.0 ? (frequencyHz - frequenciesHz[low]) / step : 0.0;
        for (std::size_t i = 0; i < channels; ++i) {
            Complex<double> sum;
            for (std::size_t j = 0; j < channels; ++j) {
                sum += at(low, i, j) * (gains[j] * (1.0 - share));
                sum += at(high, i, j) * (gains[j] * share);
            }
            inPhase[i] = sum.re;
            quadrature[i] = sum.im;
        }
    }

private:
    Complex<double> at(std::size_t k, std::size_t i, std::size_t j) const noexcept {
        return entries[(k * channels + i) * channels + j];
    }
};

} // namespace physvib
