// SPDX-License-Identifier: MIT
// Counts of what happened to a world's contacts, to diagnose why no vibration, or too little, is played.
#pragma once
#include <cstdint>
#include <string>

namespace physvib {

/// Counts since the world was made.
struct ContactCounts {
    std::uint64_t contacts = 0;       ///< pairs that began to touch, and new contact points that the engine
                                      ///< distinguishes
    std::uint64_t belowThreshold = 0; ///< of haptic sources: slower than the threshold, including new points
                                      ///< of jittering contacts
    std::uint64_t withoutSource = 0;  ///< contacts of which neither body is a haptic source
    std::uint64_t unplayable = 0; ///< impacts whose sound has no frequency or is outside the playable range
    std::uint64_t muted = 0;   ///< impacts while everything is muted, or of a haptic source with a gain of 0
    std::uint64_t dropped = 0; ///< more than there is room for, or than ImpactSettings::hitsPerStep
    std::uint64_t events = 0;  ///< events created
    double leastX = 0.0, leastY = 0.0, mostX = 0.0, mostY = 0.0; ///< bounds of the events' places, m of the
                                                                 ///< field
    double thresholdMetresPerSecond = 0.0; ///< effective value: at least 1.5 g dt of the last step
    bool hasStepped = false;               ///< true after the first step
    bool hasSources = false;               ///< a body is a haptic source now

    /// Counts an event at a place of the field.
    void made(double x, double y) noexcept;

    /// Adds the counts of another world, whose threshold is then shown.
    ContactCounts& operator+=(const ContactCounts& other) noexcept;
};

/// The most likely reason why nothing, or not everything, is felt, as one sentence. Any thread.
std::string explain(const ContactCounts& counts);

/// The output of `--explain`: the sentence, and a line per count. Any thread.
std::string describe(const ContactCounts& counts);

} // namespace physvib
