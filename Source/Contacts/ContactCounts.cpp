// SPDX-License-Identifier: MIT
// Adds contact counts, and lists them.
#include "Contacts/ContactCounts.h"
#include "Contacts/Explanations.h"
#include <algorithm>

namespace physvib {

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
    settling += other.settling;
    dropped += other.dropped;
    if (other.events > 0) {
        made(other.leastX, other.leastY);
        made(other.mostX, other.mostY);
        events += other.events - 2;
    }
    thresholdMetresPerSecond = other.thresholdMetresPerSecond;
    hasSources = other.hasSources;
    steps += other.steps;
    zeroSteps += other.zeroSteps;
    longestStepSeconds = std::max(longestStepSeconds, other.longestStepSeconds);
    outsideSteps += other.outsideSteps;
    unknownBodies += other.unknownBodies;
    if (other.unknownBodies > 0) unknownBody = other.unknownBody;
    immovable += other.immovable;
    parting += other.parting;
    motionless += other.motionless;
    strongestBelow = std::max(strongestBelow, other.strongestBelow);
    fastestParting = std::max(fastestParting, other.fastestParting);
    fastestApproach = std::max(fastestApproach, other.fastestApproach);
    gravityMetresPerSecond2 = other.gravityMetresPerSecond2;
    wantedThreshold = other.wantedThreshold;
    fieldWidthMetres = other.fieldWidthMetres;
    isMuted = other.isMuted;
    notes = other.notes; // they are about now
    return *this;
}

void ContactCounts::note(EngineNote what, std::int32_t body) noexcept {
    Noted& noted = notes[static_cast<std::size_t>(what)];
    ++noted.count;
    noted.body = body;
}

std::string describe(const ContactCounts& counts, const OutputFacts* output) {
    const auto line = [](const std::string& name, std::uint64_t count) {
        return name + " " + std::to_string(count) + "\n";
    };
    return inNames(explain(counts, counts, output), Names::scene) + "\n" + line("contacts", counts.contacts) +
           line("below the threshold of " + threeDigits(counts.thresholdMetresPerSecond) + " m/s:",
                counts.belowThreshold) +
           line("no haptic source:", counts.withoutSource) + line("unplayable:", counts.unplayable) +
           line("muted:", counts.muted + counts.settling) + line("dropped:", counts.dropped) +
           line("events:", counts.events);
}

} // namespace physvib
