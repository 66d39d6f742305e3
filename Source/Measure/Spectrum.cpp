// SPDX-License-Identifier: MIT
// All bins by Eigen's transform; single points by a rotating phasor.
#include "Measure/Spectrum.h"
#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>

namespace physvib {

Complex<double> pointOfSpectrum(std::span<const double> samples, double rateHz, double omega, double tau) {
    const double factor = std::exp(-tau / rateHz);
    const Complex<double> turn{factor * std::cos(omega / rateHz), -factor * std::sin(omega / rateHz)};
    Complex<double> sum, phasor{1.0, 0.0};
    for (const double x : samples) {
        sum += phasor * x;
        phasor = phasor * turn;
    }
    return sum;
}

std::vector<double> magnitudes(std::span<const double> samples) {
    std::vector<double> padded(samples.begin(), samples.end());
    padded.resize(std::bit_ceil(2 * samples.size()));
    std::vector<std::complex<double>> bins;
    Eigen::FFT<double> transform;
    transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
    transform.fwd(bins, padded);
    std::vector<double> all(bins.size());
    std::ranges::transform(bins, all.begin(), [](const std::complex<double>& bin) { return std::abs(bin); });
    return all;
}

} // namespace physvib
