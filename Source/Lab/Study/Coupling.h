// SPDX-License-Identifier: MIT
// What enchanters make of each other's vibration, and drives that make up for it: Eq. 3.1 and 3.2, and
// beyond.
#pragma once
#include "Core/Actuators/DriveMatrices.h"
#include "Stimuli/SeededRandom.h"
#include <complex>
#include <span>
#include <vector>

namespace physvib {

using ComplexAmplitudes = std::vector<std::complex<double>>; ///< one per enchanter, at one frequency

/// A square of complex numbers at one frequency. Of a coupling, at(i, j) is the acceleration at enchanter i
/// for a drive of 1 of enchanter j alone, as measured: 1 on the diagonal if both are in full scales. Of
/// drives, the drive of i for an amplitude of 1 at j.
struct CouplingMatrix {
    explicit CouplingMatrix(std::size_t enchanters)
        : size(enchanters)
        , entries(enchanters * enchanters) {
        for (std::size_t i = 0; i < size; ++i) at(i, i) = 1.0;
    }
    std::complex<double>& at(std::size_t i, std::size_t j) { return entries[i * size + j]; }
    std::complex<double> at(std::size_t i, std::size_t j) const { return entries[i * size + j]; }

    /// The matrix times one amplitude per enchanter.
    ComplexAmplitudes times(const ComplexAmplitudes& amplitudes) const;

    std::size_t size;
    std::vector<std::complex<double>> entries;
};

/// How much more than the strongest amplitude wanted a compensation may drive.
constexpr double mostExtraDriveDb = 3.0;

/// The matrix D of drives D a that make C D a come near the amplitudes a that are wanted: the least |C d -
/// a|^2 + lambda |d|^2 for every a (Tikhonov), so that drives of vibrations that sound at once add up. Lambda
/// is the smallest at which the strongest drive is at most `mostDecibels` above the strongest amplitude
/// wanted, whatever gains, which are not negative, the panner gives a hit. M only.
CouplingMatrix compensationMatrix(const CouplingMatrix& coupling, double mostDecibels = mostExtraDriveDb);

/// The strongest drive that gains from 0 to 1 can take, to four digits and never less than it is.
double strongestDrive(const CouplingMatrix& drives);

/// How far what is felt is from what is wanted: root of the mean power of C D - I per enchanter, in shares of
/// what is wanted.
double strayShare(const CouplingMatrix& coupling, const CouplingMatrix& drives);

/// The same coupling, every entry off by up to +-2 dB and +-20 degrees, the diagonal too: no two enchanters
/// are alike.
CouplingMatrix mismatched(CouplingMatrix coupling, SeededRandom& random);

/// Coupling as measured at one frequency or several, rising.
struct MeasuredCoupling {
    std::vector<double> frequenciesHz;
    std::vector<CouplingMatrix> matrices; ///< of one size
    std::size_t enchanters() const noexcept { return matrices.empty() ? 0 : matrices.front().size; }
};

/// Drives against it, frequency by frequency; owns what Core/Actuators/DriveMatrices.h looks at. Drives
/// between two frequencies are means of theirs, so they keep the limit too. M only.
class CouplingDrives {
public:
    CouplingDrives() = default;
    explicit CouplingDrives(const MeasuredCoupling& measured);
    /// this object outlives it
    DriveMatrices view() const noexcept { return {frequenciesHz_, entries_, channels_}; }

private:
    std::vector<double> frequenciesHz_;
    std::vector<Complex<double>> entries_;
    std::size_t channels_ = 0;
};

/// What is left of a coupling, each at its worst frequency: strayShare without and with the drives, the same
/// of a mismatched coupling (root mean square of 20 seeded draws), and the strongest drive.
struct CouplingResidual {
    double plain = 0.0, compensated = 0.0, mismatchedPlain = 0.0, mismatchedCompensated = 0.0,
           strongestDrive = 0.0;
};
CouplingResidual residualOf(const MeasuredCoupling& measured);

/// Eq. 3.1: 1 - A / A_ref, per axis; negative where the isolated side moves more. `reference` > 0.
std::vector<double> attenuationRatios(std::span<const double> isolated, std::span<const double> reference);

/// Eq. 3.2: root of the sum of squares. Unbounded: three axes of 0.9 make 1.56, so it is no share of
/// anything.
double combinedAttenuation(std::span<const double> ratios);

} // namespace physvib
