// SPDX-License-Identifier: MIT
// Mechanical coupling between actuators: its measured matrix and file, drives that compensate it, and the
// attenuation by damping layers (Eq. 3.1, 3.2).
#pragma once
#include "Core/Actuators/DriveMatrices.h"
#include "Io/Result.h"
#include "Stimuli/SeededRandom.h"
#include <complex>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

using ComplexAmplitudes = std::vector<std::complex<double>>; ///< one per actuator, at one frequency

/// A square complex matrix at one frequency. In a coupling matrix, at(i, j) is the measured acceleration at
/// actuator i for a drive of 1 of actuator j alone; the diagonal is 1 if both are in full scales. In a drive
/// matrix, at(i, j) is the drive of i for an amplitude of 1 at j.
struct CouplingMatrix {
    explicit CouplingMatrix(std::size_t enchanters)
        : size(enchanters)
        , entries(enchanters * enchanters) {
        for (std::size_t i = 0; i < size; ++i) at(i, i) = 1.0;
    }
    std::complex<double>& at(std::size_t i, std::size_t j) { return entries[i * size + j]; }
    std::complex<double> at(std::size_t i, std::size_t j) const { return entries[i * size + j]; }

    /// Product of the matrix and one amplitude per actuator.
    ComplexAmplitudes times(const ComplexAmplitudes& amplitudes) const;

    std::size_t size;
    std::vector<std::complex<double>> entries;
};

/// Maximum drive of a compensation above the strongest wanted amplitude.
constexpr double maxExtraDriveDb = 3.0;

/// The matrix D of drives D a, so that C D a approximates the wanted amplitudes a. It minimises |C d - a|^2 +
/// lambda |d|^2 for every a (Tikhonov). D is linear, so drives of simultaneous vibrations add up. Lambda is
/// the smallest value at which the strongest drive is at most `limitDb` above the strongest wanted
/// amplitude, for any panning gains >= 0. Message thread only.
CouplingMatrix compensationMatrix(const CouplingMatrix& coupling, double limitDb = maxExtraDriveDb);

/// The strongest drive for gains from 0 to 1, to four digits and rounded up.
double maxDrive(const CouplingMatrix& drives);

/// Relative error of the reproduced amplitudes: root of the mean power of C D - I per actuator.
double relativeAmplitudeError(const CouplingMatrix& coupling, const CouplingMatrix& drives);

/// Copy of the coupling with every entry, also on the diagonal, changed at random by up to +-2 dB and +-20
/// degrees. It models differences between actuators.
CouplingMatrix withRandomMismatch(CouplingMatrix coupling, SeededRandom& random);

/// Coupling as measured at one or more frequencies, ascending.
struct MeasuredCoupling {
    std::vector<double> frequenciesHz;
    std::vector<CouplingMatrix> matrices; ///< all of the same size
    std::size_t enchanters() const noexcept { return matrices.empty() ? 0 : matrices.front().size; }
};

/// Compensation drives for each measured frequency; owns the data that Core/Actuators/DriveMatrices.h refers
/// to. Drives between two frequencies are interpolated, so they keep the limit too. Message thread only.
class CouplingDrives {
public:
    CouplingDrives() = default;
    explicit CouplingDrives(const MeasuredCoupling& measured);
    /// The view is valid while this object exists.
    DriveMatrices view() const noexcept { return {frequenciesHz_, entries_, channels_}; }

private:
    std::vector<double> frequenciesHz_;
    std::vector<Complex<double>> entries_;
    std::size_t channels_ = 0;
};

/// Residual error of a coupling, each value at its worst frequency: relativeAmplitudeError without and with
/// compensation, both also for mismatched couplings (root mean square of 20 seeded draws), and the strongest
/// drive.
struct CouplingResidual {
    double uncompensated = 0.0, compensated = 0.0, mismatchedUncompensated = 0.0, mismatchedCompensated = 0.0,
           maxDrive = 0.0;
};
CouplingResidual couplingResidual(const MeasuredCoupling& measured);

/// Eq. 3.1: 1 - A / A_ref per axis; negative where the isolated side vibrates more. `reference` > 0.
std::vector<double> attenuationRatios(std::span<const double> isolated, std::span<const double> reference);

/// Eq. 3.2: root of the sum of squares. It can exceed 1 (three axes of 0.9 give 1.56).
double combinedAttenuation(std::span<const double> ratios);

// JSON files of the measured coupling between actuators.

/// Newest readable version of the format.
constexpr int couplingFormatVersion = 1;

/// Parses square matrices of 1 to limits::maxActuators rows, with magnitudes in full scales and phases in
/// degrees. Otherwise one line `name: measured[0].phase_deg[1][2]: expected ...`. Unknown and repeated fields
/// are errors. Any thread.
Result<MeasuredCoupling> readCoupling(std::string_view text, std::string_view name);

/// Reads a file with readCoupling(). Message thread only.
Result<MeasuredCoupling> loadCoupling(const std::filesystem::path& path);

/// `coupling` as JSON; readCoupling() restores it except for the last bits of its phases. Any thread.
std::string couplingJson(const MeasuredCoupling& coupling, const std::string& name,
                         const std::string& source);

// Isolation study (thesis 3.1.1): the vibration attenuation of damping layers, by condition.

/// A layer and its drive signal. All but the frequency are labels that are compared, not computed with.
struct IsolationCondition {
    std::string material, softener, thickness; ///< layer on the actuators; empty for a reference
    std::string voltage, axis;                 ///< voltage and axis of the drive
    double frequencyHz = 0.0;
};

/// One recording: a level per axis of the accelerometer.
struct IsolationMeasurement {
    IsolationCondition condition;
    bool isReference = false; ///< true: measured without a layer
    std::vector<double> levels;
    std::string source; ///< the file, for messages
};

struct IsolationResult {
    IsolationCondition condition;
    std::vector<double> gammas;         ///< Eq. 3.2 of each repetition against the drive's mean reference
    double mean = 0.0, deviation = 0.0; ///< of `gammas`; sample standard deviation, 0 for one value
};

struct IsolationStudy {
    std::string error;                    ///< error in one line; if set, the results are invalid
    std::vector<IsolationResult> results; ///< sorted: material, softener, thickness, axis, voltage, frequency
};

/// Attenuations (Eq. 3.2) of all layers by drive. Any thread (allocates).
IsolationStudy summariseIsolation(const std::vector<IsolationMeasurement>& measurements);

} // namespace physvib
