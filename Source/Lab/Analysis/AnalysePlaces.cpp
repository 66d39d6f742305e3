// SPDX-License-Identifier: MIT
// Analysis of pointing errors as text and table: means over participants of means over targets.
#include "Lab/Analysis/Analyses.h"
#include "Lab/Statistics/Moments.h"
#include <algorithm>
#include <charconv>
#include <sstream>

namespace physvib {
namespace {

/// Four significant digits, because units can be metres or pixels.
std::string significant(double number) {
    char digits[32];
    number = number == 0.0 ? 0.0 : number; // avoids -0
    return {digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 4).ptr};
}

/// "12.3, 95 % interval 10.1 to 14.5".
std::string overParticipants(const std::vector<ParticipantError>& people, double ParticipantError::*value,
                             bool ParticipantError::*has = nullptr) {
    std::vector<double> values;
    for (const ParticipantError& one : people)
        if (has == nullptr || one.*has) values.push_back(one.*value);
    if (values.empty()) return "not known";
    const Moments moments{values};
    if (moments.n < 2) return significant(moments.mean);
    return significant(moments.mean) + ", 95 % interval " +
           significant(moments.mean - moments.halfInterval()) + " to " +
           significant(moments.mean + moments.halfInterval());
}

bool isOnALine(const std::vector<PlaceTrial>& trials) {
    return std::ranges::all_of(trials, [](const PlaceTrial& t) { return t.y == 0.0 && t.trueY == 0.0; });
}

void tellErrors(std::ostream& out, const std::string& condition, const std::vector<PlaceTrial>& trials) {
    const auto people = participantErrors(trials);
    const auto most = std::ranges::max_element(people, {}, &ParticipantError::targets);
    const bool hasY = !isOnALine(trials);
    out << printable(condition) << ": " << trials.size() << " trials of "
        << counted(people.size(), "participant") << ", up to " << most->targets << " targets\n"
        << "  distance from the target: " << overParticipants(people, &ParticipantError::distance) << '\n'
        << "  constant error, x: " << overParticipants(people, &ParticipantError::constantX) << '\n';
    if (hasY)
        out << "  constant error, y: " << overParticipants(people, &ParticipantError::constantY) << '\n';
    out << "  variable error: "
        << overParticipants(people, &ParticipantError::variable, &ParticipantError::hasVariable) << '\n'
        << "  gain, x: " << overParticipants(people, &ParticipantError::gainX, &ParticipantError::hasGainX)
        << '\n';
    if (hasY)
        out << "  gain, y: "
            << overParticipants(people, &ParticipantError::gainY, &ParticipantError::hasGainY) << '\n';
}

} // namespace

AnalysisReport analysePlaces(const AnalysisJob& o) {
    if (const auto fault = unitFault(o.columns); !fault.empty()) return {fault};
    const auto data = readStudyFiles(o, readPlaces);
    if (!data) return {data.error};
    AnalysisReport report{{}, data.value.isSimulated, data.value.warnings};
    std::ostringstream out;
    ExportTable table{
        "places", data.value.isSimulated,
        "condition,participant,target,trials,true_x,true_y,constant_x,constant_y,variable,distance"};
    for (const auto& condition : data.value.conditions) {
        tellErrors(out, condition.name.empty() ? "all trials" : condition.name, condition.trials);
        for (const TargetError& one : targetErrors(condition.trials)) {
            table.row(condition.name, one.participant, one.target, one.trials, one.trueX, one.trueY,
                      one.constantX, one.constantY,
                      one.trials > 1 ? std::optional{one.variable} : std::nullopt, one.distance);
        }
    }
    report.words = out.str();
    report.table = table.text();
    return report;
}

} // namespace physvib
