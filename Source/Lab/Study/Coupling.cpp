// SPDX-License-Identifier: MIT
// Compensates coupling by Tikhonov-regularised least squares; reads its files; summarises isolation studies.
// Steps: 1. Solve (C^H C + lambda) D = C^H. 2. Compute the strongest drive of D over all gains from 0 to 1.
// 3. If it exceeds the limit, find the smallest lambda within it by bisection of log lambda.
#include "Lab/Study/Coupling.h"
#include "Core/Limits.h"
#include "Core/Units.h"
#include "Io/Disk/ReadFile.h"
#include "Io/Json/JsonField.h"
#include "Io/Json/JsonText.h"
#include "Io/Text/NumberText.h"
#include "Lab/Files/StudyTables.h"
#include "Lab/Study/Summaries.h"
#include "Scene/SceneLimits.h"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

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

CouplingMatrix compensationMatrix(const CouplingMatrix& coupling, double limitDb) {
    const double limit = fromDecibels(limitDb);
    const auto isWithinLimit = [limit](const CouplingMatrix& drives) { return maxDrive(drives) <= limit; };
    CouplingMatrix drives = drivesAt(coupling, minLambda);
    if (isWithinLimit(drives)) return drives;
    double low = std::log(minLambda), high = std::log(maxLambda);
    for (int halving = 0; halving < 40; ++halving) {
        const double middle = 0.5 * (low + high);
        (isWithinLimit(drivesAt(coupling, std::exp(middle))) ? high : low) = middle;
    }
    return drivesAt(coupling, std::exp(high));
}

// In each direction of the complex plane, a drive is largest with gain 1 for positive contributions, else 0.
double maxDrive(const CouplingMatrix& drives) {
    constexpr int directions = 360;
    double maxSum = 0.0;
    for (int k = 0; k < directions; ++k) {
        const ComplexNumber direction = std::polar(1.0, -2.0 * std::numbers::pi * k / directions);
        for (std::size_t i = 0; i < drives.size; ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j < drives.size; ++j)
                sum += std::max(0.0, (drives.at(i, j) * direction).real());
            maxSum = std::max(maxSum, sum);
        }
    }
    return maxSum / std::cos(std::numbers::pi / directions); // upper bound: the maximum may lie in between
}

double relativeAmplitudeError(const CouplingMatrix& coupling, const CouplingMatrix& drives) {
    double power = 0.0;
    for (std::size_t j = 0; j < coupling.size; ++j) {
        ComplexAmplitudes column(coupling.size);
        for (std::size_t i = 0; i < coupling.size; ++i) column[i] = drives.at(i, j);
        const ComplexAmplitudes reproduced = coupling.times(column);
        for (std::size_t i = 0; i < coupling.size; ++i)
            power += std::norm(reproduced[i] - (i == j ? 1.0 : 0.0));
    }
    return std::sqrt(power / static_cast<double>(coupling.size));
}

CouplingMatrix withRandomMismatch(CouplingMatrix coupling, SeededRandom& random) {
    const auto upTo = [&random](double limit) { return limit * (2.0 * random.uniform() - 1.0); };
    for (ComplexNumber& entry : coupling.entries) {
        const double factor = fromDecibels(upTo(mismatchDb));
        entry *= std::polar(factor, upTo(mismatchDegrees) * std::numbers::pi / 180.0);
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

CouplingResidual couplingResidual(const MeasuredCoupling& measured) {
    constexpr int draws = 20;
    CouplingResidual worst;
    const CouplingMatrix identity(measured.enchanters());
    SeededRandom random(1, "coupling");
    for (const CouplingMatrix& coupling : measured.matrices) {
        const CouplingMatrix drives = compensationMatrix(coupling);
        double before = 0.0, after = 0.0;
        for (int draw = 0; draw < draws; ++draw) {
            const CouplingMatrix mismatched = withRandomMismatch(coupling, random);
            before += std::pow(relativeAmplitudeError(mismatched, identity), 2) / draws;
            after += std::pow(relativeAmplitudeError(mismatched, drives), 2) / draws;
        }
        worst.uncompensated = std::max(worst.uncompensated, relativeAmplitudeError(coupling, identity));
        worst.compensated = std::max(worst.compensated, relativeAmplitudeError(coupling, drives));
        worst.mismatchedUncompensated = std::max(worst.mismatchedUncompensated, std::sqrt(before));
        worst.mismatchedCompensated = std::max(worst.mismatchedCompensated, std::sqrt(after));
        worst.maxDrive = std::max(worst.maxDrive, maxDrive(drives));
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

// Reads and writes coupling files, checking every number, because the file drives actuators that people hold.

namespace {

constexpr const char* couplingVersionField = "physvib_coupling";
constexpr double maxMagnitude = 4.0; // in full scales; larger values indicate a wrong unit
constexpr std::size_t maxFrequencies = 256;

std::size_t sizeOf(const JsonField& rows, std::size_t min, std::size_t max) {
    const std::size_t size = rows.arraySize();
    if (size < min || size > max)
        rows.fail("expected " +
                  (min == max ? std::to_string(min) : std::to_string(min) + " to " + std::to_string(max)) +
                  " items, found " + std::to_string(size));
    return size;
}

/// Calls `setEntry(i, j, number)` for each entry of a square matrix of `size`.
template <class SetEntry>
void readSquare(const JsonField& rows, std::size_t size, double min, double max, SetEntry setEntry) {
    sizeOf(rows, size, size);
    for (std::size_t i = 0; i < size; ++i) {
        const JsonField row = rows.item(i);
        sizeOf(row, size, size);
        for (std::size_t j = 0; j < size; ++j) setEntry(i, j, row.item(j).numberWithin(min, max));
    }
}

CouplingMatrix readMatrix(const JsonField& json) {
    const JsonField magnitudes = json["magnitude"];
    CouplingMatrix matrix(sizeOf(magnitudes, 1, limits::maxActuators));
    readSquare(magnitudes, matrix.size, 0.0, maxMagnitude,
               [&](std::size_t i, std::size_t j, double magnitude) { matrix.at(i, j) = magnitude; });
    readSquare(json["phase_deg"], matrix.size, -360.0, 360.0,
               [&](std::size_t i, std::size_t j, double degrees) {
                   matrix.at(i, j) *= std::polar(1.0, degrees * std::numbers::pi / 180.0);
               });
    for (std::size_t i = 0; i < matrix.size; ++i)
        if (!(std::abs(matrix.at(i, i)) > 0.0))
            magnitudes.item(i).item(i).fail("expected an enchanter that moves by its own drive, found 0");
    return matrix;
}

MeasuredCoupling readCouplingRoot(const JsonField& root) {
    checkVersion(root, couplingVersionField, couplingFormatVersion);
    root.expectObject({couplingVersionField, "name", "source", "measured"});
    root["name"].text();
    root["source"].text();
    const JsonField measured = root["measured"];
    MeasuredCoupling coupling;
    for (std::size_t k = 0, count = sizeOf(measured, 1, maxFrequencies); k < count; ++k) {
        const JsonField json = measured.item(k);
        json.expectObject({"frequency_hz", "magnitude", "phase_deg"});
        const double hz = json["frequency_hz"].numberWithin(limits::minMeasuredHz, limits::maxFrequencyHz);
        if (k > 0 && !(hz > coupling.frequenciesHz.back()))
            json["frequency_hz"].fail("expected frequencies that rise, found " + numberText(hz) + " after " +
                                      numberText(coupling.frequenciesHz.back()));
        coupling.frequenciesHz.push_back(hz);
        coupling.matrices.push_back(readMatrix(json));
        if (const std::size_t size = coupling.matrices.back().size; size != coupling.enchanters())
            json["magnitude"].fail("expected as many enchanters as at the first frequency, " +
                                   std::to_string(coupling.enchanters()) + ", found " + std::to_string(size));
    }
    return coupling;
}

} // namespace

Result<MeasuredCoupling> readCoupling(std::string_view text, std::string_view name) {
    return readJson(text, name, limits::maxCouplingFileBytes,
                    [](const Json& root) { return readCouplingRoot(JsonField(root, {})); });
}

std::string couplingJson(const MeasuredCoupling& coupling, const std::string& name,
                         const std::string& source) {
    OrderedJson root = {{couplingVersionField, couplingFormatVersion},
                        {"name", name},
                        {"source", source},
                        {"measured", OrderedJson::array()}};
    for (std::size_t k = 0; k < coupling.matrices.size(); ++k) {
        const auto squareOf = [&matrix = coupling.matrices[k]](auto number) {
            OrderedJson rows = OrderedJson::array();
            for (std::size_t i = 0; i < matrix.size; ++i) {
                OrderedJson row = OrderedJson::array();
                for (std::size_t j = 0; j < matrix.size; ++j) row.push_back(number(matrix.at(i, j)));
                rows.push_back(std::move(row));
            }
            return rows;
        };
        root["measured"].push_back(
            {{"frequency_hz", coupling.frequenciesHz[k]},
             {"magnitude", squareOf([](std::complex<double> c) { return std::abs(c); })},
             {"phase_deg",
              squareOf([](std::complex<double> c) { return std::arg(c) * 180.0 / std::numbers::pi; })}});
    }
    return prettyJson(root);
}

Result<MeasuredCoupling> loadCoupling(const std::filesystem::path& path) {
    return loadText(path, limits::maxCouplingFileBytes, readCoupling);
}

// Groups isolation recordings: repetitions share a condition, and layers share the reference of their drive.

namespace {

using Levels = std::vector<double>;

/// Mean levels of the reference recordings of one drive.
struct ReferenceLevels {
    Levels levels;
    std::size_t count = 0;
    bool haveSameSize = true; ///< all have the same number of channels
};
using Drive = std::tuple<std::string, std::string, double>;

Drive driveOf(const IsolationCondition& c) { return {c.axis, c.voltage, c.frequencyHz}; }

std::map<Drive, ReferenceLevels> referencesIn(const std::vector<IsolationMeasurement>& measurements) {
    std::map<Drive, ReferenceLevels> references;
    for (const IsolationMeasurement& m : measurements) {
        if (!m.isReference) continue;
        ReferenceLevels& sums = references[driveOf(m.condition)];
        if (sums.count++ == 0) sums.levels.assign(m.levels.size(), 0.0);
        sums.haveSameSize &= sums.levels.size() == m.levels.size();
        for (std::size_t i = 0; i < std::min(sums.levels.size(), m.levels.size()); ++i)
            sums.levels[i] += m.levels[i];
    }
    for (auto& [drive, sums] : references)
        for (double& level : sums.levels) level /= static_cast<double>(sums.count);
    return references;
}

} // namespace

IsolationStudy summariseIsolation(const std::vector<IsolationMeasurement>& measurements) {
    const auto references = referencesIn(measurements);
    std::map<std::tuple<std::string, std::string, std::string, Drive>, IsolationResult> results;
    for (const IsolationMeasurement& m : measurements) {
        if (m.isReference) continue;
        const auto reference = references.find(driveOf(m.condition));
        if (reference == references.end() || !reference->second.haveSameSize ||
            reference->second.levels.size() != m.levels.size())
            return {
                m.source +
                    ": expected a reference of the same frequency, voltage and axis, with as many channels",
                {}};
        if (std::ranges::any_of(reference->second.levels, [](double level) { return !(level > 0.0); }))
            return {m.source + ": expected a reference that vibrates on every channel", {}};
        IsolationResult& result = results[{m.condition.material, m.condition.softener, m.condition.thickness,
                                           driveOf(m.condition)}];
        result.condition = m.condition;
        result.gammas.push_back(combinedAttenuation(attenuationRatios(m.levels, reference->second.levels)));
    }
    if (results.empty()) return {"expected recordings behind a layer, found none", {}};
    IsolationStudy study;
    for (auto& [key, result] : results) {
        const Moments moments{result.gammas};
        result.mean = moments.mean;
        result.deviation = moments.deviation;
        study.results.push_back(std::move(result));
    }
    return study;
}

} // namespace physvib
