// SPDX-License-Identifier: MIT
// What became of a world's contacts, so that nobody wonders why nothing is felt.
#pragma once
#include <cstdint>
#include <string>

namespace physvib {

/// Counts since the beginning.
struct ContactCounts {
    std::uint64_t contacts = 0; ///< pairs that began to touch, and new points of pairs that were told apart
    std::uint64_t belowThreshold = 0; ///< of haptic sources: slower than the threshold, new points of
                                      ///< contacts that tremble too
    std::uint64_t withoutSource = 0;  ///< contacts of which neither body is a haptic source
    std::uint64_t unplayable = 0; ///< sounds of impacts without a frequency, or outside of what can be played
    std::uint64_t muted = 0;      ///< impacts while all is muted, or of a haptic source whose gain is 0
    std::uint64_t dropped = 0;    ///< more than there is room for, or than ImpactSettings::hitsPerStep
    std::uint64_t events = 0;     ///< made
    double leastX = 0.0, leastY = 0.0, mostX = 0.0, mostY = 0.0; ///< between which events lie, m of the field
    double thresholdMetresPerSecond = 0.0; ///< as it is in effect: at least 1.5 g dt of the last step
    bool hasStepped = false;               ///< any step was begun
    bool hasSources = false;               ///< any body is a haptic source now

    /// An event at a place of the field.
    void made(double x, double y) noexcept;

    /// Those of another world on top, whose threshold is the one that is shown.
    ContactCounts& operator+=(const ContactCounts& other) noexcept;
};

/// The most likely reason why nothing, or not everything, is felt: one sentence in plain words. Any thread.
std::string explain(const ContactCounts& counts);

/// What `--explain` prints: the sentence, and a line per count. Any thread.
std::string describe(const ContactCounts& counts);

} // namespace physvib
