// SPDX-License-Identifier: MIT
// Creates the events of a stimulus job; only an actuator resonance comes from the layout.
#include "Lab/Study/MakeStimulus.h"
#include "Io/Text/NumberText.h"
#include "Scene/ActuatorFile.h"

namespace physvib {
namespace {

/// Resonance frequency of all actuators. They must agree, because a phantom has one frequency.
Result<double> resonanceOf(const LayoutDescription& layout) {
    std::optional<double> found;
    for (const auto& enchanter : layout.enchanters) {
        const auto fail = [&](const std::string& why) {
            return Failure{std::string{stimulusWords::frequency} + " " + stimulusWords::resonance +
                           ": actuator " + enchanter.label + ": " + why};
        };
        if (enchanter.actuator == "none") return fail("expected an actuator, found none");
        const auto profile = findActuator(enchanter.actuator);
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

std::string layoutFault(const StimulusJob& job, const LayoutDescription& layout) {
    const auto* const named = std::get_if<PatternJob>(&job.what);
    const auto pattern = named != nullptr ? parsePatternLabel(named->label) : std::nullopt;
    for (int k = 0; pattern && k < pattern->count; ++k)
        if (pattern->enchanters[static_cast<std::size_t>(k)] >= layout.geometry.count)
            return "expected actuators among the " + std::to_string(layout.geometry.count) +
                   " of the layout, found " + inQuotes(named->label);
    return {};
}

Result<Stimulus> makeStimulus(const StimulusJob& job, const LayoutDescription& layout) {
    const auto frequencyHz = job.frequencyHz ? Result<double>{*job.frequencyHz} : resonanceOf(layout);
    if (!frequencyHz) return Failure{frequencyHz.error};
    const Carrier carrier{frequencyHz.value, job.levelG};
    if (const auto* const pattern = std::get_if<PatternJob>(&job.what))
        return patternStimulus(*parsePatternLabel(pattern->label), layout.geometry.count, carrier,
                               pattern->gapSeconds);
    const auto& phantom = *std::get_if<PhantomJob>(&job.what);
    Stimulus made = phantomStimulus(phantom.place(), layout.geometry, phantom.law, phantom.exponent, carrier,
                                    phantom.seconds);
    made.events.front().decayPerSecond = phantom.decayPerSecond;
    made.events.front().amplitude *= phantom.peakFactor(frequencyHz.value);
    return made;
}

} // namespace physvib
