// SPDX-License-Identifier: MIT
// Fourier transforms by Eigen, and single spectral points by a rotating phasor.
#include "Measure/Spectrum.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace physvib {

Complex<double> spectrumValue(std::span<const double> samples, double rateHz, double omega, double tau) {
    const double factor = std::exp(-tau / rateHz);
    const Complex<double> rotation{factor * std::cos(omega / rateHz), -factor * std::sin(omega / rateHz)};
    Complex<double> sum, phasor{1.0, 0.0};
    for (const double x : samples) {
        sum += phasor * x;
        phasor = phasor * rotation;
    }
    return sum;
}

namespace {

using Transform = Eigen::FFT<double>;

/// Bins 0 to n/2 of the n points to which the samples are zero-padded.
std::vector<std::complex<double>> computeBins(Transform& transform, std::span<const double> samples) {
    std::vector<double> padded(samples.begin(), samples.end());
    padded.resize(std::bit_ceil(2 * samples.size()));
    std::vector<std::complex<double>> bins;
    transform.SetFlag(Transform::HalfSpectrum);
    transform.fwd(bins, padded);
    return bins;
}

} // namespace

std::vector<double> magnitudes(std::span<const double> samples) {
    Transform transform;
    const auto bins = computeBins(transform, samples);
    std::vector<double> all(bins.size());
    std::ranges::transform(bins, all.begin(), [](const std::complex<double>& bin) { return std::abs(bin); });
    return all;
}

std::vector<double> autocorrelation(std::span<const double> samples) {
    Transform transform;
    auto bins = computeBins(transform, samples);
    for (auto& bin : bins) bin = std::norm(bin); // Wiener-Khinchin theorem
    std::vector<double> all;
    transform.inv(all, bins);
    all.resize(samples.size());
    return all;
}

} // namespace physvib
