// SPDX-License-Identifier: MIT
// Spectra of short recordings: all bins by a fast Fourier transform, or the value at one frequency.
#pragma once
#include "Core/Trigonometry.h"
#include <span>
#include <vector>

namespace physvib {

/// sum x[i] exp(-(tau + i omega) i / rateHz): the spectrum at tau = 0, a matched filter otherwise. Any
/// thread.
Complex<double> pointOfSpectrum(std::span<const double> samples, double rateHz, double omega, double tau);

/// Magnitudes of bins 0 to n/2 of the n points to which the samples are zero-padded (at least twice as many,
/// a power of two); bin k is at k rateHz / n. Message thread (M) only (allocates).
std::vector<double> magnitudes(std::span<const double> samples);

/// sum x[i] x[i + lag], for lags of 0 to size - 1. M only (allocates).
std::vector<double> autocorrelation(std::span<const double> samples);

} // namespace physvib
