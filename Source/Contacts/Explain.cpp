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

std::string formatPlaces(const ContactCounts& c) {
    return "at x " + formatThreeDigits(c.minX) + " to " + formatThreeDigits(c.maxX) + " m, y " +
           formatThreeDigits(c.minY) + " to " + formatMetres(c.maxY);
}

std::string engineReason(const ContactCounts& c) {
    const auto max = std::ranges::max_element(c.notes, {}, &ContactCounts::NoteCount::count);
    if (max->count == 0) return {};
    const std::string who =
        "No contact of a haptic source has begun: body " + std::to_string(max->body) +
        (max->count > 1 ? " (and " + countWithNoun(max->count - 1, "other source") + ")" : std::string{});
    switch (static_cast<EngineNote>(max - c.notes.begin())) {
    case EngineNote::sensor: return who + " is a sensor, which touches nothing: make it solid.";
    case EngineNote::filtered:
        return who +
               " is filtered: its collision filter (category, mask, group) lets it touch no other body.";
    case EngineNote::disabled: return who + " is disabled in the engine: enable it.";
    case EngineNote::asleep: break;
    }
    return who + " is asleep: it rests until something wakes it.";
}

std::string longStepReason(const ContactCounts& c) {
    return "Steps were up to " + formatThreeDigits(c.longestStepSeconds) +
           " s long, more than a frame (0.05 s), so bodies pass each other and the threshold is " +
           formatSpeed(c.thresholdMetresPerSecond) +
           ": make several steps of 0.01 s (seconds, not milliseconds).";
}

std::string noContactReason(const ContactCounts& c) {
    if (c.zeroSteps == c.steps)
        return "Steps were 0 s long, so nothing moved: give physvib_world_begin_step the seconds since the "
               "last step.";
    if (std::string reason = engineReason(c); !reason.empty()) return reason;
    if (c.longestStepSeconds > frameSeconds) return longStepReason(c);
    return "No contact has begun in " + countWithNoun(c.steps, "step") +
           (c.mayBePushed ? "" : " (what is to be felt has a mass of 0: it meets only what moves freely)") +
           ": nothing has touched, or contacts are not reported (physvib_world_touch).";
}

std::string belowThresholdReason(const ContactCounts& c) {
    const std::uint64_t slow =
        c.belowThreshold - std::min(c.belowThreshold, c.immovable + c.parting + c.motionless);
    const std::uint64_t max = std::max({slow, c.immovable, c.parting, c.motionless});
    if (max == c.immovable)
        return "Both bodies of a contact have a mass of 0, so neither can be pushed: set mass_kg of the one "
               "that moves.";
    if (max == c.motionless)
        return "Contacts were reported without a speed: set approach_m_per_s or impulse_n_s, or call "
               "physvib_world_move with each body's motion before its contacts.";
    if (max == c.parting)
        return "Bodies part along the reported normal, at up to " +
               formatSpeed(c.fastestPartingMetresPerSecond) +
               ": it must point from a to b (turn it round), and speeds be those before the engine's solver.";
    if (c.gravityMetresPerSecond2 > strongGravity)
        return "Gravity is " + formatThreeDigits(c.gravityMetresPerSecond2) +
               " m/s^2, which looks like pixels and raises the threshold to " +
               formatSpeed(c.thresholdMetresPerSecond) + ": " + divideByPixels;
    const std::string strongest =
        " (the strongest impact had " + formatSpeed(c.strongestBelowMetresPerSecond) + "): ";
    const std::string slower = "Contacts of haptic sources were slower than the threshold of " +
                               formatSpeed(c.thresholdMetresPerSecond);
    if (c.thresholdMetresPerSecond <= c.configuredThresholdMetresPerSecond)
        return slower + strongest + "set threshold_m_per_s lower than that (0.15 at first).";
    if (c.longestStepSeconds > frameSeconds) return longStepReason(c);
    return slower + ", which is 1.5 times what gravity adds in a step" + strongest + "make shorter steps.";
}

std::string noEventsReason(const ContactCounts& c) {
    if (c.unknownBodies > c.contacts)
        return "Contacts name a body that the world does not know (" + std::to_string(c.unknownBody) +
               "): call physvib_world_set_body for every body that touches, floors too.";
    if (!c.hasSources) return "No body is a haptic source: set is_camera of the bodies that are to be felt.";
    if (c.contacts == 0) return noContactReason(c);
    const std::uint64_t max = std::max({c.belowThreshold, c.unplayable, c.muted, c.settling, c.dropped});
    if (c.handedOn > max)
        return "A movable source passed on " + countWithNoun(c.handedOn, "impact") +
               " between its neighbours: push and reaction cancel (Eq. 5.4), so it has no event: "
               "set is_camera of what strikes or of what stands still.";
    if (c.withoutSource == c.contacts && max == 0) {
        const std::string reason = engineReason(c);
        return reason.empty()
                   ? "No body that touched is a haptic source: set is_camera of the bodies that are "
                     "to be felt."
                   : reason;
    }
    if (max == 0)
        return "Contacts of haptic sources have begun, but none of them was reported with a speed or an "
               "impulse that strikes.";
    if (max == c.muted)
        return c.isMuted ? "Impacts were muted: set is_muted of the world to false."
                         : "Impacts were muted by a gain of 0 of the haptic source: set its gain (1).";
    if (max == c.settling)
        return "Impacts came while the world settles, in the first settling_s of its time: set it lower.";
    if (max == c.unplayable)
        return "Impacts have no sound: set frequency_hz and decay_per_s of the haptic source (or its "
               "voice to that of what strikes it), and its mass_kg or static_mass_kg.";
    if (max == c.dropped)
        return "Impacts were left out: more came in a step than hits_per_step or there is memory for.";
    return belowThresholdReason(c);
}

double farthest(const ContactCounts& c) {
    return std::max({std::abs(c.minX), std::abs(c.maxX), std::abs(c.minY), std::abs(c.maxY)});
}

// Only what the world itself knows: the width of its field.
std::string fieldReason(const ContactCounts& c, const std::string& text) {
    constexpr double defaultMetres = 1.0, beside = 0.05; // bodies sink into walls at the edge
    const double width = c.fieldWidthMetres;
    if (width <= 0.0 || (c.minX >= -beside * width && c.maxX <= (1.0 + beside) * width)) return {};
    return text +
           (width == defaultMetres
                ? ", outside the field of 1 m, as it is at first: set field_width_m"
                : ", outside the field of " + formatMetres(width) + ": set field_width_m") +
           " of the world and of the renderer or device to what x spans.";
}

std::string explainEvents(const ContactCounts& c, const OutputFacts* output) {
    const std::string text =
        countWithNoun(c.events, "event") + (c.events == 1 ? " was" : " were") + " made, " + formatPlaces(c);
    const bool isOfMetres = c.fieldWidthMetres < farMetres;
    if (isOfMetres && farthest(c) > farMetres)
        return text + ", in a field of " + formatMetres(c.fieldWidthMetres) + ": this looks like pixels; " +
               divideByPixels;
    if (isOfMetres && c.gravityMetresPerSecond2 > strongGravity)
        return text + ", under a gravity of " + formatThreeDigits(c.gravityMetresPerSecond2) +
               " m/s^2: this looks like pixels; " + divideByPixels;
    if (output != nullptr)
        if (std::string reason = outputReason(c, *output); !reason.empty()) return reason;
    if (std::string reason = fieldReason(c, text); !reason.empty()) return reason;
    if (c.longestStepSeconds > frameSeconds) return longStepReason(c);
    if (isOfMetres && c.fastestApproachMetresPerSecond > fastMetresPerSecond)
        return text + ", at up to " + formatSpeed(c.fastestApproachMetresPerSecond) +
               ": this looks like pixels; " + divideByPixels;
    if (output != nullptr)
        return text + ", and reach the output: if nothing is felt, look at amplifier and cables.";
    return text +
           ": nothing is wrong in this world. What plays it was not looked at: the field of the renderer or "
           "device must "
           "span these places (field_width_m; at first it is the layout, centimetres), and its level be up.";
}

std::string sentence(const ContactCounts& c, const OutputFacts* output) {
    if (c.steps == 0 && c.outsideSteps > 0)
        return "No step has begun when contacts are reported: report them within a step "
               "(physvib_world_begin_step and physvib_world_end_step).";
    if (c.steps == 0)
        return "No step has been made: make one for each step of the engine (physvib_world_begin_step and "
               "physvib_world_end_step).";
    return c.events > 0 ? explainEvents(c, output) : noEventsReason(c);
}

} // namespace

std::string explain(const ContactCounts& recent, const ContactCounts& total, const OutputFacts* output) {
    if (recent.hasActivity() || !total.hasActivity()) return sentence(recent, output);
    return "Nothing was stepped since the last explanation; before: " + sentence(total, output);
}

} // namespace physvib
