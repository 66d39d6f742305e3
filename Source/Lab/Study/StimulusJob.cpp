// SPDX-License-Identifier: MIT
// Checks stimulus jobs against their valid ranges, converts them to calls, and creates their events.
#include "Lab/Study/StimulusJob.h"
#include "Core/Actuators/Exposure.h"
#include "Core/PortableMath.h"
#include "Io/Text/NumberText.h"
#include "Lab/Study/Experiment.h"
#include "Lab/Study/Protocol.h"
#include "Scene/ActuatorFile.h"
#include <cmath>
#include <complex>
#include <numbers>

namespace physvib {
namespace {

namespace options = stimulusOptions;
namespace ranges = parameterRanges;

JobError rangeError(std::string_view option, double number, const ParameterRange& range) {
    if (range.contains(number)) return {};
    return {option, numberText(range.min) + " to " + numberText(range.max)};
}

JobError placeError(const FieldPlace& place) {
    if (ranges::share.contains(place.x) && ranges::share.contains(place.y)) return {};
    return {options::place, "X,Y from 0 to 1"};
}

JobError placeError(const GridPlace& place) {
    const auto isLine = [](int line, int lines) { return line >= 1 && line <= lines; };
    constexpr int maxLines = static_cast<int>(maxGridLines);
    if (!isLine(place.grid.columns, maxLines) || !isLine(place.grid.rows, maxLines))
        return {options::grid, "COLUMNSxROWS like 7x5"};
    if (!isLine(place.cell.column, place.grid.columns) || !isLine(place.cell.row, place.grid.rows))
        return {options::cell, "r,c of the grid (row 1 is the upper one)"};
    return {};
}

JobError kindError(const PatternJob& pattern) {
    if (!parsePatternLabel(pattern.label))
        return {{}, "a pattern like ABA-250 (one to three enchanters, then milliseconds)"};
    return rangeError(options::gap, pattern.gapSeconds, ranges::gapSeconds);
}

JobError kindError(const PhantomJob& phantom) {
    if (auto error = std::visit([](const auto& place) { return placeError(place); }, phantom.target))
        return error;
    if (auto error = rangeError(options::exponent, phantom.exponent, ranges::exponent)) return error;
    if (auto error = rangeError(options::decay, phantom.decayPerSecond, ranges::decayPerSecond)) return error;
    return rangeError(options::seconds, phantom.seconds, ranges::seconds);
}

/// Integral over the length of the squared weighted samples of a tone that begins at peak 1. Without a
/// sample rate: by the poles of tone and weighting, so no transform warps frequencies.
double weightedSquares(double frequencyHz, double decayPerSecond, double seconds) noexcept {
    using Complex = std::complex<double>;
    using namespace handWeighting;
    const auto radians = [](double hz) { return 2.0 * std::numbers::pi * hz; };
    std::array<Complex, 8> poles{Complex{-decayPerSecond, radians(frequencyHz)}};
    std::size_t pole = 1;
    for (const auto& [hz, q] :
         {std::pair{lowHz, bandQ}, std::pair{highHz, bandQ}, std::pair{transitionHz, transitionQ}}) {
        poles[pole] = radians(hz) * Complex{-0.5 / q, std::sqrt(1.0 - 0.25 / (q * q))};
        ++pole;
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
            const Complex sum = poles[k] + poles[j]; // 0 if the tone does not decay
            squares += residues[k] * residues[j] *
                       (sum == 0.0 ? seconds : (portable::exp(sum * seconds) - 1.0) / sum);
        }
    return squares.real();
}

} // namespace

double PhantomJob::peakFactor(double frequencyHz) const noexcept {
    if (levelMeasure == LevelMeasure::weighted)
        return std::sqrt(0.5 * seconds / weightedSquares(frequencyHz, decayPerSecond, seconds));
    const double energyDecay = 2.0 * decayPerSecond, // integral of the squared envelope, in s:
        envelopeSeconds =
            energyDecay > 0.0 ? -portable::expm1(-energyDecay * seconds) / energyDecay : seconds;
    return levelMeasure == LevelMeasure::peak
               ? 1.0
               : std::sqrt((levelMeasure == LevelMeasure::rms ? seconds : 1.0) / envelopeSeconds);
}

JobError jobError(const StimulusJob& job) {
    if (auto error = std::visit([](const auto& kind) { return kindError(kind); }, job.stimulus)) return error;
    if (job.frequencyHz)
        if (auto error = rangeError(options::frequency, *job.frequencyHz, ranges::frequencyHz))
            return {error.option, error.expected + " Hz, or " + options::resonance};
    return rangeError(options::levelG, job.levelG, ranges::levelG);
}

// Converts stimulus jobs to the calls that are stored in the rows of trial files.

namespace {

constexpr std::string_view middles = "middles";

class CallWriter {
public:
    explicit CallWriter(std::string words)
        : text{std::move(words)} {}
    CallWriter& add(std::string_view word, std::string_view value) {
        text.append(" ").append(word).append(" ").append(value);
        return *this;
    }
    CallWriter& add(std::string_view word, double value) { return add(word, numberText(value)); }
    CallWriter& addCarrier(const StimulusJob& job) {
        return add(options::layout, job.layout)
            .add(options::frequency, job.frequencyHz ? numberText(*job.frequencyHz) : options::resonance)
            .add(options::levelG, job.levelG);
    }
    std::string text;
};

void addPlace(CallWriter& call, const FieldPlace& place) {
    call.add(options::place, numberText(place.x) + "," + numberText(place.y));
}

void addPlace(CallWriter& call, const GridPlace& place) {
    call.add(options::grid, std::to_string(place.grid.columns) + "x" + std::to_string(place.grid.rows))
        .add(options::cell, gridLabel(place.cell));
    if (place.grid.points == PhantomGrid::Points::middles) call.add(options::points, middles);
}

/// The value of an option in a call; empty if the call does not have it.
std::string_view optionValue(std::string_view call, std::string_view word) noexcept {
    while (!call.empty()) {
        const std::size_t end = std::min(call.find(' '), call.size());
        const bool isFound = call.substr(0, end) == word;
        call.remove_prefix(std::min(end + 1, call.size()));
        if (isFound) return call.substr(0, call.find(' '));
    }
    return {};
}

std::string textOf(const PatternJob& pattern, const StimulusJob& job) {
    return CallWriter{"stimulus pattern " + pattern.label}
        .addCarrier(job)
        .add(options::gap, pattern.gapSeconds)
        .text;
}

std::string textOf(const PhantomJob& phantom, const StimulusJob& job) {
    CallWriter call{"stimulus phantom"};
    std::visit([&](const auto& place) { addPlace(call, place); }, phantom.target);
    call.addCarrier(job).add(options::law, nameOf(phantom.law)).add(options::exponent, phantom.exponent);
    if (phantom.decayPerSecond != 0.0) call.add(options::decay, phantom.decayPerSecond);
    if (phantom.levelMeasure != LevelMeasure::peak)
        call.add(options::levelMeasure, levelMeasureNames[static_cast<std::size_t>(phantom.levelMeasure)]);
    return call.add(options::seconds, phantom.seconds).text;
}

} // namespace

std::string textOf(const StimulusJob& job) {
    return std::visit([&](const auto& kind) { return textOf(kind, job); }, job.stimulus);
}

std::optional<PhantomGrid> parseGrid(std::string_view call) noexcept {
    const std::string_view lines = optionValue(call, options::grid);
    const std::size_t separator = std::min(lines.find('x'), lines.size());
    const auto columns = parseNumber<int>(lines.substr(0, separator)),
               rows = parseNumber<int>(lines.substr(std::min(separator + 1, lines.size())));
    const auto isCount = [](std::optional<int> n) {
        return n && *n >= 1 && *n <= static_cast<int>(maxGridLines);
    };
    if (!isCount(columns) || !isCount(rows)) return std::nullopt;
    using Points = PhantomGrid::Points;
    return PhantomGrid{*columns, *rows,
                       optionValue(call, options::points) == middles ? Points::middles : Points::corners};
}

std::string addSoundOptions(const Protocol& protocol, std::string call) {
    if (call.find("--method SV") == std::string::npos) return call;
    for (const StudySoundFile& sound : protocol.sounds) {
        const std::string quote = sound.file.find(' ') == std::string::npos ? "" : "\"";
        call += " --sound " + quote + numberText(sound.frequencyHz) + "=" + sound.file + quote;
    }
    return call;
}

std::string resolvedCalls(const Protocol& protocol, const TrialRecord& record) {
    std::string text;
    const auto add = [&](const std::string& call) { text.append(text.empty() ? "" : " ; ").append(call); };
    for (const std::string& session : record.answer.worldSessions) add("render " + session);
    if (!text.empty()) return text;
    for (const TrialJob& job : trialJobs(protocol, record))
        add(std::visit([](const auto& call) { return textOf(call); }, job));
    return text;
}

// Creates the events of a stimulus job; only an actuator resonance comes from the layout.

namespace {

/// Resonance frequency of all actuators. They must agree, because a phantom has one frequency.
Result<double> findResonance(const LayoutDescription& layout) {
    std::optional<double> found;
    for (const auto& actuator : layout.actuators) {
        const auto fail = [&](const std::string& why) {
            return Failure{std::string{stimulusOptions::frequency} + " " + stimulusOptions::resonance +
                           ": actuator " + actuator.label + ": " + why};
        };
        if (actuator.actuator == "none") return fail("expected an actuator, found none");
        const auto profile = findActuator(actuator.actuator);
        if (!profile) return fail(profile.error);
        const auto hz = profile.value.resonanceHz;
        if (!hz)
            return fail(profile.value.name +
                        ": resonance_hz is not known (measure it with physvib calibrate)");
        if (*hz < limits::slowestToneHz)
            return fail("expected at least " + numberText(limits::slowestToneHz) + " Hz, found " +
                        numberText(*hz) + " Hz");
        if (found && *found != *hz)
            return fail("expected the resonance of the others, " + numberText(*found) + " Hz, found " +
                        numberText(*hz) + " Hz");
        found = hz;
    }
    return *found;
}

} // namespace

std::string layoutError(const StimulusJob& job, const LayoutDescription& layout) {
    const auto* const named = std::get_if<PatternJob>(&job.stimulus);
    const auto pattern = named != nullptr ? parsePatternLabel(named->label) : std::nullopt;
    for (int k = 0; pattern && k < pattern->count; ++k)
        if (pattern->actuators[static_cast<std::size_t>(k)] >= layout.geometry.count)
            return "expected actuators among the " + std::to_string(layout.geometry.count) +
                   " of the layout, found " + inQuotes(named->label);
    return {};
}

Result<Stimulus> makeStimulus(const StimulusJob& job, const LayoutDescription& layout) {
    const auto frequencyHz = job.frequencyHz ? Result<double>{*job.frequencyHz} : findResonance(layout);
    if (!frequencyHz) return Failure{frequencyHz.error};
    const Carrier carrier{frequencyHz.value, job.levelG};
    if (const auto* const pattern = std::get_if<PatternJob>(&job.stimulus))
        return patternStimulus(*parsePatternLabel(pattern->label), layout.geometry.count, carrier,
                               pattern->gapSeconds);
    const auto& phantom = *std::get_if<PhantomJob>(&job.stimulus);
    Stimulus stimulus = phantomStimulus(phantom.place(), layout.geometry, phantom.law, phantom.exponent,
                                        carrier, phantom.seconds);
    stimulus.events.front().decayPerSecond = phantom.decayPerSecond;
    stimulus.events.front().amplitude *= phantom.peakFactor(frequencyHz.value);
    return stimulus;
}

} // namespace physvib
