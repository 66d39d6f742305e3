// SPDX-License-Identifier: MIT
// Checks a stimulus job against its valid ranges.
#include "Lab/Study/StimulusJob.h"
#include "Core/Actuators/Exposure.h"
#include "Lab/Study/NumberWord.h"
#include "Lab/Study/PercentCounts.h"
#include <cmath>
#include <complex>
#include <numbers>

namespace physvib {
namespace {

namespace words = stimulusWords;
namespace ranges = stimulusRanges;

JobFault rangeFault(std::string_view word, double number, const StimulusRange& range) {
    if (range.holds(number)) return {};
    return {word, numberWord(range.least) + " to " + numberWord(range.most)};
}

JobFault placeFault(const FieldPlace& place) {
    if (ranges::share.holds(place.x) && ranges::share.holds(place.y)) return {};
    return {words::at, "X,Y from 0 to 1"};
}

JobFault placeFault(const GridPlace& place) {
    const auto isLine = [](int line, int lines) { return line >= 1 && line <= lines; };
    constexpr int most = static_cast<int>(mostGridLines);
    if (!isLine(place.grid.columns, most) || !isLine(place.grid.rows, most))
        return {words::grid, "COLUMNSxROWS like 7x5"};
    if (!isLine(place.cell.column, place.grid.columns) || !isLine(place.cell.row, place.grid.rows))
        return {words::cell, "r,c of the grid (row 1 is the upper one)"};
    return {};
}

JobFault faultOfKind(const PatternJob& pattern) {
    if (!parsePatternLabel(pattern.label))
        return {{}, "a pattern like ABA-250 (one to three enchanters, then milliseconds)"};
    return rangeFault(words::gap, pattern.gapSeconds, ranges::gapSeconds);
}

JobFault faultOfKind(const PhantomJob& phantom) {
    if (auto fault = std::visit([](const auto& place) { return placeFault(place); }, phantom.at))
        return fault;
    if (auto fault = rangeFault(words::exponent, phantom.exponent, ranges::exponent)) return fault;
    if (auto fault = rangeFault(words::decay, phantom.decayPerSecond, ranges::decayPerSecond)) return fault;
    return rangeFault(words::seconds, phantom.seconds, ranges::seconds);
}

/// Integral over the length of the squared weighted samples of a tone that begins at peak 1. Without a
/// sample rate: by the poles of tone and weighting, so no transform warps frequencies.
double weightedSquares(double frequencyHz, double decayPerSecond, double seconds) noexcept {
    using Complex = std::complex<double>;
    using namespace handWeighting;
    const auto radians = [](double hz) { return 2.0 * std::numbers::pi * hz; };
    std::array<Complex, 8> poles{Complex{-decayPerSecond, radians(frequencyHz)}};
    std::size_t at = 1;
    for (const auto& [hz, q] :
         {std::pair{lowHz, bandQ}, std::pair{highHz, bandQ}, std::pair{transitionHz, transitionQ}}) {
        poles[at] = radians(hz) * Complex{-0.5 / q, std::sqrt(1.0 - 0.25 / (q * q))};
        ++at;
    }
    for (std::size_t k = 0; k < 4; ++k) poles[4 + k] = std::conj(poles[k]);
    const double high = radians(highHz), transition = radians(transitionHz),
                 gain = radians(frequencyHz) * high * high * transition;
    std::array<Complex, 8> residues;
    for (std::size_t k = 0; k < 8; ++k) {
        residues[k] = gain * poles[k] * poles[k] * (poles[k] + transition);
        for (std::size_t j = 0; j < 8; ++j)
            if (j != k) residues[k] /= poles[k] - poles[j];
    }
    Complex squares;
    for (std::size_t k = 0; k < 8; ++k)
        for (std::size_t j = 0; j < 8; ++j) {
            const Complex both = poles[k] + poles[j]; // 0 of a tone that does not decay
            squares +=
                residues[k] * residues[j] * (both == 0.0 ? seconds : (std::exp(both * seconds) - 1.0) / both);
        }
    return squares.real();
}

} // namespace

FieldPlace PhantomJob::place() const noexcept {
    if (const auto* const point = std::get_if<GridPlace>(&at)) return point->grid.place(point->cell);
    return *std::get_if<FieldPlace>(&at);
}

double PhantomJob::peakFactor(double frequencyHz) const noexcept {
    if (levelOf == LevelOf::weighted)
        return std::sqrt(0.5 * seconds / weightedSquares(frequencyHz, decayPerSecond, seconds));
    const double twice = 2.0 * decayPerSecond, // integral of the squared envelope, in s:
        envelopeSeconds = twice > 0.0 ? -std::expm1(-twice * seconds) / twice : seconds;
    return levelOf == LevelOf::peak ? 1.0
                                    : std::sqrt((levelOf == LevelOf::rms ? seconds : 1.0) / envelopeSeconds);
}

JobFault faultOf(const StimulusJob& job) {
    if (auto fault = std::visit([](const auto& kind) { return faultOfKind(kind); }, job.what)) return fault;
    if (job.frequencyHz)
        if (auto fault = rangeFault(words::frequency, *job.frequencyHz, ranges::frequencyHz))
            return {fault.word, fault.expected + " Hz, or " + words::resonance};
    return rangeFault(words::levelG, job.levelG, ranges::levelG);
}

} // namespace physvib
