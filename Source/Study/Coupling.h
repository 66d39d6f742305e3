// SPDX-License-Identifier: MIT
// What enchanters make of each other's vibration, and drives that make up for it: Eq. 3.1 and 3.2, and beyond.
#pragma once
#include <complex>
#include <span>
#include <vector>

namespace physvib {

using ComplexAmplitudes = std::vector<std::complex<double>>; ///< one per enchanter, at one frequency

/// at(i, j): acceleration at enchanter i for a drive of 1 of enchanter j alone, as measured; 1 on the diagonal if drives are in
/// full scales.
struct CouplingMatrix {
    explicit CouplingMatrix(std::size_t enchanters) : size(enchanters), entries(enchanters * enchanters) {
        for (std::size_t i = 0; i < size; ++i) at(i, i) = 1.0;
    }
    std::complex<double>& at(std::size_t i, std::size_t j) { return entries[i * size + j]; }
    std::complex<double> at(std::size_t i, std::size_t j) const { return entries[i * size + j]; }
    ComplexAmplitudes felt(const ComplexAmplitudes& drives) const;

    std::size_t size;
    std::vector<std::complex<double>> entries;
};

/// Drives d that make C d come near what is wanted: the least |C d - a|^2 + lambda |d|^2, with the smallest lambda at which the
/// strongest drive is at most `mostDecibels` above the strongest amplitude wanted. M only.
ComplexAmplitudes compensated(const CouplingMatrix& coupling, const ComplexAmplitudes& wanted, double mostDecibels = 3.0);

/// Eq. 3.1: 1 - A / A_ref, per axis; negative where the isolated side moves more. `reference` > 0.
std::vector<double> attenuationRatios(std::span<const double> isolated, std::span<const double> reference);

/// Eq. 3.2: root of the sum of squares. Unbounded: three axes of 0.9 make 1.56, so it is no share of anything.
double combinedAttenuation(std::span<const double> ratios);

} // namespace physvib
