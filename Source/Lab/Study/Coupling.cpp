// SPDX-License-Identifier: MIT
// Compensation of mechanical coupling by Tikhonov-regularised least squares over complex amplitudes.
// Steps: 1. Solve (C^H C + lambda) D = C^H. 2. Compute the strongest drive of D over all gains from 0 to 1.
// 3. If it exceeds the limit, find the smallest lambda within it by bisection of log lambda.
#include "Lab/Study/Coupling.h"
#include "Core/Units.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace physvib {
namespace {

using ComplexNumber = std::complex<double>;

constexpr double minLambda = 1e-9, maxLambda = 1e3; // of full scale squared: from none to drives near zero
constexpr double mismatchDb = 2.0, mismatchDegrees = 20.0;

using Entries = Eigen::Matrix<ComplexNumber, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// (C^H C + lambda)^-1 C^H, the matrix being positive definite for lambda > 0.
CouplingMatrix drivesAt(const CouplingMatrix& coupling, double lambda) {
    const auto n = static_cast<Eigen::Index>(coupling.size);
    const Eigen::Map<const Entries> c{coupling.entries.data(), n, n};
    Eigen::MatrixXcd damped = c.adjoint() * c;
    damped.diagonal().array() += lambda;
    CouplingMatrix drives(coupling.size);
    Eigen::Map<Entries>{drives.entries.data(), n, n} = damped.ldlt().solve(c.adjoint());
    return drives;
}

} // namespace

ComplexAmplitudes CouplingMatrix::times(const ComplexAmplitudes& amplitudes) const {
    ComplexAmplitudes sums(size);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t j = 0; j < size; ++j) sums[i] += at(i, j) * amplitudes[j];
    return sums;
}

CouplingMatrix compensationMatrix(const CouplingMatrix& coupling, double mostDecibels) {
    const double limit = fromDecibels(mostDecibels);
    const auto keeps = [limit](const CouplingMatrix& drives) { return strongestDrive(drives) <= limit; };
    CouplingMatrix drives = drivesAt(coupling, minLambda);
    if (keeps(drives)) return drives;
    double low = std::log(minLambda), high = std::log(maxLambda);
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (keeps(drivesAt(coupling, std::exp(middle))) ? high : low) = middle;
    }
    return drivesAt(coupling, std::exp(high));
}

// For a phase direction, the drive is largest with gain 1 for each positive contribution, 0 for the rest.
double strongestDrive(const CouplingMatrix& drives) {
    constexpr int directions = 360;
    double most = 0.0;
    for (int k = 0; k < directions; ++k) {
        const ComplexNumber towards = std::polar(1.0, -2.0 * std::numbers::pi * k / directions);
        for (std::size_t i = 0; i < drives.size; ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j < drives.size; ++j)
                sum += std::max(0.0, (drives.at(i, j) * towards).real());
            most = std::max(most, sum);
        }
    }
    return most / std::cos(std::numbers::pi / directions); // upper bound: the maximum may lie in between
}

double strayShare(const CouplingMatrix& coupling, const CouplingMatrix& drives) {
    double power = 0.0;
    for (std::size_t j = 0; j < coupling.size; ++j) {
        ComplexAmplitudes column(coupling.size);
        for (std::size_t i = 0; i < coupling.size; ++i) column[i] = drives.at(i, j);
        const ComplexAmplitudes felt = coupling.times(column);
        for (std::size_t i = 0; i < coupling.size; ++i) power += std::norm(felt[i] - (i == j ? 1.0 : 0.0));
    }
    return std::sqrt(power / static_cast<double>(coupling.size));
}

CouplingMatrix mismatched(CouplingMatrix coupling, SeededRandom& random) {
    const auto upTo = [&random](double most) { return most * (2.0 * random.uniform() - 1.0); };
    for (ComplexNumber& entry : coupling.entries) {
        const double share = fromDecibels(upTo(mismatchDb));
        entry *= std::polar(share, upTo(mismatchDegrees) * std::numbers::pi / 180.0);
    }
    return coupling;
}

CouplingDrives::CouplingDrives(const MeasuredCoupling& measured)
    : frequenciesHz_{measured.frequenciesHz}
    , channels_{measured.enchanters()} {
    for (const CouplingMatrix& coupling : measured.matrices)
        for (const ComplexNumber& entry : compensationMatrix(coupling).entries)
            entries_.push_back({entry.real(), entry.imag()});
}

CouplingResidual residualOf(const MeasuredCoupling& measured) {
    constexpr int draws = 20;
    CouplingResidual worst;
    const CouplingMatrix plain(measured.enchanters());
    SeededRandom random(1, "coupling");
    for (const CouplingMatrix& coupling : measured.matrices) {
        const CouplingMatrix drives = compensationMatrix(coupling);
        double before = 0.0, after = 0.0;
        for (int draw = 0; draw < draws; ++draw) {
            const CouplingMatrix truth = mismatched(coupling, random);
            before += std::pow(strayShare(truth, plain), 2) / draws;
            after += std::pow(strayShare(truth, drives), 2) / draws;
        }
        worst.plain = std::max(worst.plain, strayShare(coupling, plain));
        worst.compensated = std::max(worst.compensated, strayShare(coupling, drives));
        worst.mismatchedPlain = std::max(worst.mismatchedPlain, std::sqrt(before));
        worst.mismatchedCompensated = std::max(worst.mismatchedCompensated, std::sqrt(after));
        worst.strongestDrive = std::max(worst.strongestDrive, strongestDrive(drives));
    }
    return worst;
}

std::vector<double> attenuationRatios(std::span<const double> isolated, std::span<const double> reference) {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(isolated.size(), reference.size()); ++i)
        ratios.push_back(1.0 - isolated[i] / reference[i]);
    return ratios;
}

double combinedAttenuation(std::span<const double> ratios) {
    double sum = 0.0;
    for (const double ratio : ratios) sum += ratio * ratio;
    return std::sqrt(sum);
}

} // namespace physvib
