// SPDX-License-Identifier: MIT
// Spectra of short recordings: all bins by a fast Fourier transform, or the value at one frequency.
#pragma once
#include "Core/Trigonometry.h"
#include <cstddef>
#include <span>
#include <vector>

namespace physvib {
/// sum x[i] exp(-(tau + i omega) i / rateHz): the spectrum at tau = 0, else a matched filter. Any thread.
Complex<double> spectrumValue(std::span<const double> samples, double rateHz, double omega, double tau);

/// Magnitudes of bins 0 to n/2 of the n points to which the samples are zero-padded (at least twice as many,
/// a power of two); bin k is at k rateHz / n. Message thread (M) only (allocates).
std::vector<double> magnitudes(std::span<const double> samples);

/// sum x[i] x[i + lag], for lags of 0 to size - 1. Message thread only (allocates).
std::vector<double> autocorrelation(std::span<const double> samples);

/// A local maximum of a sequence, interpolated between samples.
struct Peak {
    double position, height;
};

/// Vertex of the parabola through x[i - 1], x[i] and x[i + 1], the middle one the highest. Any thread.
inline Peak peakAt(std::span<const double> x, std::size_t i) {
    const double curvature = x[i - 1] - 2.0 * x[i] + x[i + 1],
                 offset = curvature < 0.0 ? 0.5 * (x[i - 1] - x[i + 1]) / curvature : 0.0;
    return {static_cast<double>(i) + offset, x[i] - 0.25 * (x[i - 1] - x[i + 1]) * offset};
}

/// True if x[i] is a local maximum. Any thread.
inline bool isPeak(std::span<const double> x, std::size_t i) { return x[i] > x[i - 1] && x[i] >= x[i + 1]; }

/// All peaks above 0. Any thread (allocates).
inline std::vector<Peak> findPeaks(std::span<const double> x) {
    std::vector<Peak> all;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
        if (isPeak(x, i) && x[i] > 0.0) all.push_back(peakAt(x, i));
    return all;
}

} // namespace physvib
