// SPDX-License-Identifier: MIT
// Checks a stimulus job against its valid ranges.
#include "Lab/Study/StimulusJob.h"
#include "Lab/Study/NumberWord.h"
#include "Lab/Study/PercentCounts.h"
#include <cmath>

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

} // namespace

FieldPlace PhantomJob::place() const noexcept {
    if (const auto* const point = std::get_if<GridPlace>(&at)) return point->grid.place(point->cell);
    return *std::get_if<FieldPlace>(&at);
}

double PhantomJob::peakFactor() const noexcept {
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
