// SPDX-License-Identifier: MIT
// Sums and listings of contact counts; number formats and names that explanations share.
#include "Contacts/ContactCounts.h"
#include <algorithm>
#include <cstdio>

namespace physvib {

namespace {

struct Name {
    std::string_view inC, inCpp, inScene, inMixer = inScene;
};

// Where a name is the beginning of another, the longer one comes first.
constexpr std::array names{
    Name{"field_width_m and field_height_m", "fieldWidthMetres and fieldHeightMetres", "the field (--field)"},
    Name{"set is_camera of", "set isCamera of", "set camera of", "with Select, tick 'haptic source' of"},
    Name{"set frequency_hz and decay_per_s", "set frequencyHz and decayPerSecond",
         "set frequency_hz and decay_per_s", "set, under Materials, frequency and decay"},
    Name{"mass_kg or static_mass_kg", "massKg or staticMassKg", "mass_kg", "density"},
    Name{"physvib_world_set_body", "ContactFeed::set", "a body"},
    Name{"physvib_world_begin_step", "beginStep", "--steps"},
    Name{"physvib_world_end_step", "endStep", "--steps"},
    Name{"physvib_world_touch", "ContactFeed::touch", "contacts"},
    Name{"physvib_world_move", "ContactFeed::move", "motions"},
    Name{"threshold_m_per_s", "thresholdMetresPerSecond", "the threshold", "the scene's threshold"},
    Name{"approach_m_per_s", "approachMetresPerSecond", "the approach"},
    Name{"hits_per_step", "hitsPerStep", "the hits per step"},
    Name{"field_width_m", "fieldWidthMetres", "field_m"},
    Name{"settling_s", "settlingSeconds", "the settling time"},
    Name{"impulse_n_s", "impulseNewtonSeconds", "the impulse"},
    Name{"is_muted", "isMuted", "mute"},
    Name{"mass_kg", "massKg", "mass_kg", "the density"},
};

} // namespace

ContactCounts& ContactCounts::operator+=(const ContactCounts& other) noexcept {
    contacts += other.contacts;
    belowThreshold += other.belowThreshold;
    withoutSource += other.withoutSource;
    unplayable += other.unplayable;
    muted += other.muted;
    settling += other.settling;
    dropped += other.dropped;
    handedOn += other.handedOn;
    addEvents({other.events, other.minX, other.minY, other.maxX, other.maxY});
    thresholdMetresPerSecond = other.thresholdMetresPerSecond;
    hasSources = other.hasSources;
    mayBePushed = other.mayBePushed;
    steps += other.steps;
    zeroSteps += other.zeroSteps;
    longestStepSeconds = std::max(longestStepSeconds, other.longestStepSeconds);
    outsideSteps += other.outsideSteps;
    unknownBodies += other.unknownBodies;
    if (other.unknownBodies > 0) unknownBody = other.unknownBody;
    immovable += other.immovable;
    parting += other.parting;
    motionless += other.motionless;
    strongestBelowMetresPerSecond =
        std::max(strongestBelowMetresPerSecond, other.strongestBelowMetresPerSecond);
    fastestPartingMetresPerSecond =
        std::max(fastestPartingMetresPerSecond, other.fastestPartingMetresPerSecond);
    fastestApproachMetresPerSecond =
        std::max(fastestApproachMetresPerSecond, other.fastestApproachMetresPerSecond);
    gravityMetresPerSecond2 = other.gravityMetresPerSecond2;
    configuredThresholdMetresPerSecond = other.configuredThresholdMetresPerSecond;
    fieldWidthMetres = other.fieldWidthMetres;
    isMuted = other.isMuted;
    notes = other.notes; // they are about now
    return *this;
}

void ContactCounts::note(EngineNote kind, std::int32_t body) noexcept {
    NoteCount& noted = notes[static_cast<std::size_t>(kind)];
    ++noted.count;
    noted.body = body;
}

std::string describe(const ContactCounts& counts, const OutputFacts* output) {
    const auto line = [](const std::string& name, std::uint64_t count) {
        return name + " " + std::to_string(count) + "\n";
    };
    return replaceNames(explain(counts, counts, output), Names::scene) + "\n" +
           line("contacts", counts.contacts) +
           line("below the threshold of " + formatThreeDigits(counts.thresholdMetresPerSecond) + " m/s:",
                counts.belowThreshold) +
           line("no haptic source:", counts.withoutSource) + line("unplayable:", counts.unplayable) +
           line("muted:", counts.muted + counts.settling) + line("dropped:", counts.dropped) +
           line("handed on by movable sources:", counts.handedOn) + line("events:", counts.events);
}

std::string formatThreeDigits(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    std::string number = text.data();
    std::replace(number.begin(), number.end(), ',', '.'); // whatever the locale
    return number;
}

std::string countWithNoun(std::uint64_t count, std::string_view noun) {
    return std::to_string(count) + " " + std::string(noun) + (count == 1 ? "" : "s");
}

std::string replaceNames(std::string sentence, Names vocabulary) {
    std::string replaced;
    for (std::string_view text = sentence; !text.empty();) {
        const auto match =
            std::ranges::find_if(names, [&](const Name& name) { return text.starts_with(name.inC); });
        const bool isWord = match != names.end();
        if (isWord)
            replaced += vocabulary == Names::cpp     ? match->inCpp
                        : vocabulary == Names::scene ? match->inScene
                                                     : match->inMixer;
        else
            replaced += text.front();
        text.remove_prefix(isWord ? match->inC.size() : 1);
    }
    return replaced;
}

} // namespace physvib
