// SPDX-License-Identifier: MIT
// Turns contact counts into a diagnosis in plain words: each reason has its own sentence.
#include "Contacts/ContactCounts.h"
#include <algorithm>
#include <cmath>

namespace physvib {

namespace {

// Beyond these a world in metres does not fit a hand: its numbers look like pixels.
constexpr double farMetres = 100.0, fastMetresPerSecond = 50.0, strongGravity = 100.0;
constexpr double frameSeconds = 0.05; // the longest step that a game takes

std::string formatMetres(double value) { return formatThreeDigits(value) + " m"; }
std::string formatSpeed(double value) { return formatThreeDigits(value) + " m/s"; }

constexpr const char* divideByPixels = "report metres: divide lengths by the pixels of a metre (100, say).";

std::string formatPlaces(const ContactCounts& counts) {
    return "at x " + formatThreeDigits(counts.minX) + " to " + formatThreeDigits(counts.maxX) + " m, y " +
           formatThreeDigits(counts.minY) + " to " + formatMetres(counts.maxY);
}

std::string engineReason(const ContactCounts& counts) {
    const auto max = std::ranges::max_element(counts.notes, {}, &ContactCounts::NoteCount::count);
    if (max->count == 0) return {};
    const std::string subject =
        "No contact of a haptic source has begun: body " + std::to_string(max->body) +
        (max->count > 1 ? " (and " + countWithNoun(max->count - 1, "other source") + ")" : std::string{});
    switch (static_cast<EngineNote>(max - counts.notes.begin())) {
    case EngineNote::sensor: return subject + " is a sensor, which touches nothing: make it solid.";
    case EngineNote::filtered:
        return subject +
               " is filtered: its collision filter (category, mask, group) lets it touch no other body.";
    case EngineNote::disabled: return subject + " is disabled in the engine: enable it.";
    case EngineNote::asleep: break;
    }
    return subject + " is asleep: it rests until something wakes it.";
}

std::string longStepReason(const ContactCounts& counts) {
    return "Steps were up to " + formatThreeDigits(counts.longestStepSeconds) +
           " s long, more than a frame (0.05 s), so bodies pass each other and the threshold is " +
           formatSpeed(counts.thresholdMetresPerSecond) +
           ": make several steps of 0.01 s (seconds, not milliseconds).";
}

std::string noContactReason(const ContactCounts& counts) {
    if (counts.zeroSteps == counts.steps)
        return "Steps were 0 s long, so nothing moved: give physvib_world_begin_step the seconds since the "
               "last step.";
    if (std::string reason = engineReason(counts); !reason.empty()) return reason;
    if (counts.longestStepSeconds > frameSeconds) return longStepReason(counts);
    return "No contact has begun in " + countWithNoun(counts.steps, "step") +
           (counts.mayBePushed ? ""
                               : " (what is to be felt has a mass of 0: it meets only what moves freely)") +
           ": nothing has touched, or contacts are not reported (physvib_world_touch).";
}

std::string belowThresholdReason(const ContactCounts& counts) {
    const std::uint64_t slow =
        counts.belowThreshold -
        std::min(counts.belowThreshold, counts.immovable + counts.parting + counts.motionless);
    const std::uint64_t max = std::max({slow, counts.immovable, counts.parting, counts.motionless});
    if (max == counts.immovable)
        return "Both bodies of a contact have a mass of 0, so neither can be pushed: set mass_kg of the one "
               "that moves.";
    if (max == counts.motionless)
        return "Contacts were reported without a speed: set approach_m_per_s or impulse_n_s, or call "
               "physvib_world_move with each body's motion before its contacts.";
    if (max == counts.parting)
        return "Bodies part along the reported normal, at up to " +
               formatSpeed(counts.fastestPartingMetresPerSecond) +
               ": it must point from a to b (turn it round), and speeds be those before the engine's solver.";
    if (counts.gravityMetresPerSecond2 > strongGravity)
        return "Gravity is " + formatThreeDigits(counts.gravityMetresPerSecond2) +
               " m/s^2, which looks like pixels and raises the threshold to " +
               formatSpeed(counts.thresholdMetresPerSecond) + ": " + divideByPixels;
    const std::string strongest =
        " (the strongest impact had " + formatSpeed(counts.strongestBelowMetresPerSecond) + "): ";
    const std::string slower = "Contacts of haptic sources were slower than the threshold of " +
                               formatSpeed(counts.thresholdMetresPerSecond);
    if (counts.thresholdMetresPerSecond <= counts.configuredThresholdMetresPerSecond)
        return slower + strongest + "set threshold_m_per_s lower than that (0.15 at first).";
    if (counts.longestStepSeconds > frameSeconds) return longStepReason(counts);
    return slower + ", which is 1.5 times what gravity adds in a step" + strongest + "make shorter steps.";
}

std::string noEventsReason(const ContactCounts& counts) {
    if (counts.unknownBodies > counts.contacts)
        return "Contacts name a body that the world does not know (" + std::to_string(counts.unknownBody) +
               "): call physvib_world_set_body for every body that touches, floors too.";
    if (!counts.hasSources)
        return "No body is a haptic source: set is_camera of the bodies that are to be felt.";
    if (counts.contacts == 0) return noContactReason(counts);
    const std::uint64_t max =
        std::max({counts.belowThreshold, counts.unplayable, counts.muted, counts.settling, counts.dropped});
    if (counts.handedOn > max)
        return "A movable source passed on " + countWithNoun(counts.handedOn, "impact") +
               " between its neighbours: push and reaction cancel (Eq. 5.4), so it has no event: "
               "set is_camera of what strikes or of what stands still.";
    if (counts.withoutSource == counts.contacts && max == 0) {
        const std::string reason = engineReason(counts);
        return reason.empty()
                   ? "No body that touched is a haptic source: set is_camera of the bodies that are "
                     "to be felt."
                   : reason;
    }
    if (max == 0)
        return "Contacts of haptic sources have begun, but none of them was reported with a speed or an "
               "impulse that strikes.";
    if (max == counts.muted)
        return counts.isMuted ? "Impacts were muted: set is_muted of the world to false."
                              : "Impacts were muted by a gain of 0 of the haptic source: set its gain (1).";
    if (max == counts.settling)
        return "Impacts came while the world settles, in the first settling_s of its time: set it lower.";
    if (max == counts.unplayable)
        return "Impacts have no sound: set frequency_hz and decay_per_s of the haptic source (or its "
               "voice to that of what strikes it), and its mass_kg or static_mass_kg.";
    if (max == counts.dropped)
        return "Impacts were left out: more came in a step than hits_per_step or there is memory for.";
    return belowThresholdReason(counts);
}

double farthest(const ContactCounts& counts) {
    return std::max(
        {std::abs(counts.minX), std::abs(counts.maxX), std::abs(counts.minY), std::abs(counts.maxY)});
}

// Only what the world itself knows: the width of its field.
std::string fieldReason(const ContactCounts& counts, const std::string& text) {
    constexpr double defaultMetres = 1.0, margin = 0.05; // bodies sink into walls at the edge
    const double width = counts.fieldWidthMetres;
    if (width <= 0.0 || (counts.minX >= -margin * width && counts.maxX <= (1.0 + margin) * width)) return {};
    return text +
           (width == defaultMetres
                ? ", outside the field of 1 m, as it is at first: set field_width_m"
                : ", outside the field of " + formatMetres(width) + ": set field_width_m") +
           " of the world and of the renderer or device to what x spans.";
}

std::string explainEvents(const ContactCounts& counts, const OutputFacts* output) {
    const std::string text = countWithNoun(counts.events, "event") + (counts.events == 1 ? " was" : " were") +
                             " made, " + formatPlaces(counts);
    const bool isInMetres = counts.fieldWidthMetres < farMetres;
    if (isInMetres && farthest(counts) > farMetres)
        return text + ", in a field of " + formatMetres(counts.fieldWidthMetres) +
               ": this looks like pixels; " + divideByPixels;
    if (isInMetres && counts.gravityMetresPerSecond2 > strongGravity)
        return text + ", under a gravity of " + formatThreeDigits(counts.gravityMetresPerSecond2) +
               " m/s^2: this looks like pixels; " + divideByPixels;
    if (output != nullptr)
        if (std::string reason = outputReason(counts, *output); !reason.empty()) return reason;
    if (std::string reason = fieldReason(counts, text); !reason.empty()) return reason;
    if (counts.longestStepSeconds > frameSeconds) return longStepReason(counts);
    if (isInMetres && counts.fastestApproachMetresPerSecond > fastMetresPerSecond)
        return text + ", at up to " + formatSpeed(counts.fastestApproachMetresPerSecond) +
               ": this looks like pixels; " + divideByPixels;
    if (output != nullptr)
        return text + ", and reach the output: if nothing is felt, look at amplifier and cables.";
    return text +
           ": nothing is wrong in this world. What plays it was not looked at: the field of the renderer or "
           "device must "
           "span these places (field_width_m; at first it is the layout, centimetres), and its level be up.";
}

std::string sentence(const ContactCounts& counts, const OutputFacts* output) {
    if (counts.steps == 0 && counts.outsideSteps > 0)
        return "No step has begun when contacts are reported: report them within a step "
               "(physvib_world_begin_step and physvib_world_end_step).";
    if (counts.steps == 0)
        return "No step has been made: make one for each step of the engine (physvib_world_begin_step and "
               "physvib_world_end_step).";
    return counts.events > 0 ? explainEvents(counts, output) : noEventsReason(counts);
}

} // namespace

std::string explain(const ContactCounts& recent, const ContactCounts& total, const OutputFacts* output) {
    if (recent.hasActivity() || !total.hasActivity()) return sentence(recent, output);
    return "Nothing was stepped since the last explanation; before: " + sentence(total, output);
}

} // namespace physvib
