// SPDX-License-Identifier: MIT
// Turns the contact counts into a diagnosis in plain words.
#include "Contacts/ContactCounts.h"
#include <algorithm>
#include <array>
#include <cstdio>
#include <string_view>

namespace physvib {

namespace {

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    std::string shown = text.data();
    std::replace(shown.begin(), shown.end(), ',', '.'); // whatever the locale
    return shown;
}

std::string counted(std::uint64_t count, std::string_view what) {
    return std::to_string(count) + " " + std::string(what) + (count == 1 ? "" : "s");
}

} // namespace

void ContactCounts::made(double x, double y) noexcept {
    const bool isFirst = events++ == 0;
    leastX = isFirst ? x : std::min(leastX, x);
    leastY = isFirst ? y : std::min(leastY, y);
    mostX = isFirst ? x : std::max(mostX, x);
    mostY = isFirst ? y : std::max(mostY, y);
}

ContactCounts& ContactCounts::operator+=(const ContactCounts& other) noexcept {
    contacts += other.contacts;
    belowThreshold += other.belowThreshold;
    withoutSource += other.withoutSource;
    unplayable += other.unplayable;
    muted += other.muted;
    dropped += other.dropped;
    if (other.events > 0) {
        made(other.leastX, other.leastY);
        made(other.mostX, other.mostY);
        events += other.events - 2;
    }
    thresholdMetresPerSecond = other.thresholdMetresPerSecond;
    hasStepped = hasStepped || other.hasStepped;
    hasSources = hasSources || other.hasSources;
    return *this;
}

std::string explain(const ContactCounts& counts) {
    if (!counts.hasStepped) return "No step has been made: step the world through PhysVib.";
    if (counts.contacts == 0)
        return "No contact has begun: nothing has touched yet, or contacts are not told to PhysVib.";
    if (counts.events > 0)
        return counted(counts.events, "event") + (counts.events == 1 ? " was" : " were") + " made, at x " +
               number(counts.leastX) + " to " + number(counts.mostX) + " m, y " + number(counts.leastY) +
               " to " + number(counts.mostY) +
               " m: if nothing is felt, the field of the renderer or device must span "
               "these places (by default it is the layout, centimetres); then look at the levels.";
    if (!counts.hasSources || counts.withoutSource == counts.contacts)
        return "No body that touched is a haptic source: set is_camera (C++: isCamera) of the bodies that "
               "are to feel.";
    const std::uint64_t most =
        std::max({counts.belowThreshold, counts.unplayable, counts.muted, counts.dropped});
    if (most == 0)
        return "Contacts of haptic sources have begun, but none of them was told with a speed or an impulse "
               "that strikes.";
    if (most == counts.muted)
        return "Impacts were muted: by is_muted (C++: isMuted), or by a gain of 0 of the haptic source.";
    if (most == counts.unplayable)
        return "Impacts have no sound: set the frequency and the decay of the haptic source (or its voice to "
               "that of what strikes it), and its mass.";
    if (most == counts.dropped)
        return "Impacts were left out: more came in a step than hits_per_step (C++: hitsPerStep) or there is "
               "memory for.";
    return "Contacts of haptic sources were slower than the threshold of " +
           number(counts.thresholdMetresPerSecond) +
           " m/s: lower it, or make smaller steps (it is at least 1.5 times what gravity adds in a step).";
}

std::string describe(const ContactCounts& counts) {
    const auto line = [](const std::string& name, std::uint64_t count) {
        return name + " " + std::to_string(count) + "\n";
    };
    return explain(counts) + "\n" + line("contacts", counts.contacts) +
           line("below the threshold of " + number(counts.thresholdMetresPerSecond) + " m/s:",
                counts.belowThreshold) +
           line("no haptic source:", counts.withoutSource) + line("unplayable:", counts.unplayable) +
           line("muted:", counts.muted) + line("dropped:", counts.dropped) + line("events:", counts.events);
}

} // namespace physvib
