// SPDX-License-Identifier: MIT
// Converts stimulus jobs to the calls that are stored in the rows of trial files.
#include "Io/Text/NumberText.h"
#include "Lab/Study/NumberWord.h"
#include "Lab/Study/PercentCounts.h"
#include "Lab/Study/Trial.h"
#include <algorithm>

namespace physvib {
namespace {

namespace words = stimulusWords;
constexpr std::string_view middles = "middles";

class CallWriter {
public:
    explicit CallWriter(std::string words)
        : text{std::move(words)} {}
    CallWriter& add(std::string_view word, std::string_view value) {
        text.append(" ").append(word).append(" ").append(value);
        return *this;
    }
    CallWriter& add(std::string_view word, double value) { return add(word, numberWord(value)); }
    CallWriter& addCarrier(const StimulusJob& job) {
        return add(words::layout, job.layout)
            .add(words::frequency, job.frequencyHz ? numberWord(*job.frequencyHz) : words::resonance)
            .add(words::levelG, job.levelG);
    }
    std::string text;
};

void addPlace(CallWriter& call, const FieldPlace& place) {
    call.add(words::at, numberWord(place.x) + "," + numberWord(place.y));
}

void addPlace(CallWriter& call, const GridPlace& place) {
    call.add(words::grid, std::to_string(place.grid.columns) + "x" + std::to_string(place.grid.rows))
        .add(words::cell, gridLabel(place.cell));
    if (place.grid.points == PhantomGrid::Points::middles) call.add(words::points, middles);
}

/// The value of an option in a call; empty if the call does not have it.
std::string_view valueOf(std::string_view call, std::string_view word) noexcept {
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
        .add(words::gap, pattern.gapSeconds)
        .text;
}

std::string textOf(const PhantomJob& phantom, const StimulusJob& job) {
    CallWriter call{"stimulus phantom"};
    std::visit([&](const auto& place) { addPlace(call, place); }, phantom.at);
    call.addCarrier(job).add(words::law, nameOf(phantom.law)).add(words::exponent, phantom.exponent);
    if (phantom.decayPerSecond != 0.0) call.add(words::decay, phantom.decayPerSecond);
    if (phantom.levelOf != LevelOf::peak)
        call.add(words::levelOf, levelOfNames[static_cast<std::size_t>(phantom.levelOf)]);
    return call.add(words::seconds, phantom.seconds).text;
}

} // namespace

std::string textOf(const StimulusJob& job) {
    return std::visit([&](const auto& kind) { return textOf(kind, job); }, job.what);
}

std::optional<PhantomGrid> gridOf(std::string_view call) noexcept {
    const std::string_view lines = valueOf(call, words::grid);
    const std::size_t by = std::min(lines.find('x'), lines.size());
    const auto columns = parseNumber<int>(lines.substr(0, by)),
               rows = parseNumber<int>(lines.substr(std::min(by + 1, lines.size())));
    const auto isCount = [](std::optional<int> n) {
        return n && *n >= 1 && *n <= static_cast<int>(mostGridLines);
    };
    if (!isCount(columns) || !isCount(rows)) return std::nullopt;
    using Points = PhantomGrid::Points;
    return PhantomGrid{*columns, *rows,
                       valueOf(call, words::points) == middles ? Points::middles : Points::corners};
}

std::string withSounds(const Protocol& protocol, std::string call) {
    if (call.find("--method SV") == std::string::npos) return call;
    for (const StudySoundFile& sound : protocol.sounds) {
        const std::string quote = sound.file.find(' ') == std::string::npos ? "" : "\"";
        call += " --sound " + quote + numberWord(sound.frequencyHz) + "=" + sound.file + quote;
    }
    return call;
}

std::string callsOf(const Protocol& protocol, const TrialRecord& record) {
    std::string text;
    const auto add = [&](const std::string& call) { text.append(text.empty() ? "" : " ; ").append(call); };
    for (const std::string& session : record.answer.sessions) add("render " + session);
    if (!text.empty()) return text;
    for (const TrialJob& job : jobsOf(protocol, record))
        add(std::visit([](const auto& one) { return textOf(one); }, job));
    return text;
}

} // namespace physvib
