// SPDX-License-Identifier: MIT
// Finds why events that were made are not felt: device, silence, level, channels, field.
#include "Contacts/ContactCounts.h"
#include "Core/PhantomPanner.h"
#include "Core/Units.h"
#include <algorithm>
#include <array>

namespace physvib {

namespace {

constexpr double imperceptible = 1.0e-3; // of full scale: below the threshold of touch

struct Place {
    double x, y;
};

std::array<Place, 5> samplePlaces(const ContactCounts& counts) {
    return {{{0.5 * (counts.minX + counts.maxX), 0.5 * (counts.minY + counts.maxY)},
             {counts.minX, counts.minY},
             {counts.minX, counts.maxY},
             {counts.maxX, counts.minY},
             {counts.maxX, counts.maxY}}};
}

// The largest gain at that place, of channels for which `plays(channel)` is true.
template <class Plays>
double gainAt(const Place& place, const PhantomPanner& panner, Plays plays) {
    PhantomPanner::Gains gains{};
    panner.gainsAt(place.x, place.y, gains);
    double largest = 0.0;
    for (int j = 0; j < panner.channels(); ++j)
        if (plays(j)) largest = std::max(largest, gains[static_cast<std::size_t>(j)]);
    return largest;
}

// True if those channels play no place of the events.
template <class Plays>
bool areAllSilent(const ContactCounts& counts, const PhantomPanner& panner, Plays plays) {
    const auto isSilentAt = [&](const Place& place) { return gainAt(place, panner, plays) < imperceptible; };
    return std::ranges::all_of(samplePlaces(counts), isSilentAt);
}

bool isAnyChannel(int) noexcept { return true; }

// A twentieth beyond the field counts as inside, because bodies sink into walls at the edge.
bool isOutside(double min, double max, double length) noexcept {
    return max < -0.05 * length || min > 1.05 * length;
}

std::string outsideFieldReason(const ContactCounts& counts, const PhantomPanner& panner) {
    const double width = panner.fieldWidthMetres(), height = panner.fieldHeightMetres();
    const bool isLayoutField = width == panner.layout().extentWidthMetres;
    return "Events lie outside the renderer's field" +
           std::string(isLayoutField ? ", which is not set and so the layout's: " : " of ") +
           formatThreeDigits(width) + " x " + formatThreeDigits(height) + " m; they span x " +
           formatThreeDigits(counts.minX) + " to " + formatThreeDigits(counts.maxX) + " m, y " +
           formatThreeDigits(counts.minY) + " to " + formatThreeDigits(counts.maxY) +
           " m: set field_width_m and field_height_m of the renderer.";
}

std::string placeReason(const ContactCounts& counts, const OutputFacts& output) {
    const PhantomPanner& panner = *output.panner;
    const int channels = output.channels > 0 ? output.channels : panner.channels();
    const auto isPlayed = [&](int j) { return j < channels && (output.mutedChannels >> j & 1U) == 0; };
    const bool isCovered = !areAllSilent(counts, panner, isAnyChannel);
    if (isOutside(counts.minX, counts.maxX, panner.fieldWidthMetres()) ||
        (!isCovered && isOutside(counts.minY, counts.maxY, panner.fieldHeightMetres())))
        return outsideFieldReason(counts, panner);
    if (!isCovered)
        return "The layout does not cover the places of the events: none of its actuators plays them.";
    if (channels < panner.channels())
        return "The device has " + countWithNoun(static_cast<std::uint64_t>(channels), "channel") +
               ", but the layout " + std::to_string(panner.channels()) +
               " actuators: choose a layout with as many, or another device.";
    if (areAllSilent(counts, panner, isPlayed))
        return "The channels that play these places are muted, or their gain is 0: unmute them, or set their "
               "gain.";
    return {};
}

// Some of the events are not played, because they lie outside.
bool isPartlyOutside(const ContactCounts& counts, const PhantomPanner& panner) {
    return std::ranges::any_of(samplePlaces(counts), [&](const Place& place) {
        return (isOutside(place.x, place.x, panner.fieldWidthMetres()) ||
                isOutside(place.y, place.y, panner.fieldHeightMetres())) &&
               gainAt(place, panner, isAnyChannel) < imperceptible;
    });
}

} // namespace

std::string outputReason(const ContactCounts& counts, const OutputFacts& output) {
    const std::string error = output.error.empty() ? "" : " (" + std::string(output.error) + ")";
    if (output.isMissing) return "No device plays the events" + error + ": open one, or connect it again.";
    if (output.isSilent)
        return "Silence is held" +
               (output.silentBy.empty() ? std::string{} : " by " + std::string(output.silentBy)) +
               ": end it where it was asked for.";
    if (output.levelGain <= 0.0) return "The level of the output is 0: set it to 1, or to -12 dB.";
    if (output.levelGain < 1.01 * imperceptible)
        return "The level of the output is " + formatThreeDigits(toDecibels(output.levelGain)) +
               " dB, which nobody feels: raise it, to -12 dB at first.";
    if (output.dropped > 0)
        return countWithNoun(output.dropped, "event") +
               " found the renderer's queue full: pull samples all the time, or send fewer events.";
    if (output.rejected > 0)
        return countWithNoun(output.rejected, "event") +
               " cannot be played: frequency_hz must be below half the sample rate.";
    if (output.panner != nullptr)
        if (std::string reason = placeReason(counts, output); !reason.empty()) return reason;
    if (output.late > 0)
        return countWithNoun(output.late, "event") +
               " came late and were played at once: send them earlier, or raise the latency (longest_gap_s).";
    if (output.withoutPart > 0)
        return countWithNoun(output.withoutPart, "event") +
               " belong to a part of the body that no actuator is on, and are felt by their place on all: "
               "give the layout's actuators that part, or the body another.";
    if (output.levelGain < 0.03)
        return "The level of the output is low, " + formatThreeDigits(toDecibels(output.levelGain)) +
               " dB: raise it.";
    if (output.panner != nullptr && isPartlyOutside(counts, *output.panner))
        return outsideFieldReason(counts, *output.panner);
    return output.error.empty() ? "" : "The device reports: " + std::string(output.error) + ".";
}

} // namespace physvib
