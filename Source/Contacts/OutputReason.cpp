// SPDX-License-Identifier: MIT
// Why events that were made are not felt: device, silence, level, channels, field.
#include "Contacts/ContactCounts.h"
#include "Core/PhantomPanner.h"
#include "Core/Units.h"
#include <algorithm>
#include <array>

namespace physvib {

namespace {

constexpr double inaudible = 1.0e-3; // of full scale: below the threshold of touch

struct Place {
    double x, y;
};

std::array<Place, 5> placesOf(const ContactCounts& made) {
    return {{{0.5 * (made.leastX + made.mostX), 0.5 * (made.leastY + made.mostY)},
             {made.leastX, made.leastY},
             {made.leastX, made.mostY},
             {made.mostX, made.leastY},
             {made.mostX, made.mostY}}};
}

// The largest gain at that place, of channels for which `plays(channel)` is true.
template <class Plays>
double gainAt(const Place& place, const PhantomPanner& panner, Plays plays) {
    PhantomPanner::Gains gains{};
    panner.gainsAt(place.x, place.y, gains);
    double most = 0.0;
    for (int j = 0; j < panner.channels(); ++j)
        if (plays(j)) most = std::max(most, gains[static_cast<std::size_t>(j)]);
    return most;
}

// True if those channels play no place of the events.
template <class Plays>
bool isUnfelt(const ContactCounts& made, const PhantomPanner& panner, Plays plays) {
    const auto isUnfeltThere = [&](const Place& at) { return gainAt(at, panner, plays) < inaudible; };
    return std::ranges::all_of(placesOf(made), isUnfeltThere);
}

bool any(int) noexcept { return true; }

// A twentieth beyond the field counts as inside, because bodies sink into walls at the edge.
bool isOutside(double least, double most, double length) noexcept {
    return most < -0.05 * length || least > 1.05 * length;
}

std::string fieldWords(const ContactCounts& made, const PhantomPanner& panner) {
    const double width = panner.fieldWidthMetres(), height = panner.fieldHeightMetres();
    const bool isLayouts = width == panner.layout().extentWidthMetres;
    return "Events lie outside the renderer's field" +
           std::string(isLayouts ? ", which is not set and so the layout's: " : " of ") + threeDigits(width) +
           " x " + threeDigits(height) + " m; they span x " + threeDigits(made.leastX) + " to " +
           threeDigits(made.mostX) + " m, y " + threeDigits(made.leastY) + " to " + threeDigits(made.mostY) +
           " m: set field_width_m and field_height_m of the renderer.";
}

std::string placeReason(const ContactCounts& made, const OutputFacts& output) {
    const PhantomPanner& panner = *output.panner;
    const int there = output.channels > 0 ? output.channels : panner.channels();
    const auto isHeard = [&](int j) { return j < there && (output.mutedChannels >> j & 1U) == 0; };
    const bool isCovered = !isUnfelt(made, panner, any);
    if (isOutside(made.leastX, made.mostX, panner.fieldWidthMetres()) ||
        (!isCovered && isOutside(made.leastY, made.mostY, panner.fieldHeightMetres())))
        return fieldWords(made, panner);
    if (!isCovered)
        return "The layout does not cover the places of the events: none of its actuators plays them.";
    if (there < panner.channels())
        return "The device has " + counted(static_cast<std::uint64_t>(there), "channel") +
               ", but the layout " + std::to_string(panner.channels()) +
               " actuators: choose a layout with as many, or another device.";
    if (isUnfelt(made, panner, isHeard))
        return "The channels that play these places are muted, or their gain is 0: unmute them, or set their "
               "gain.";
    return {};
}

// Some of the events are not played, because they lie outside.
bool isPartlyOutside(const ContactCounts& made, const PhantomPanner& panner) {
    return std::ranges::any_of(placesOf(made), [&](const Place& at) {
        return (isOutside(at.x, at.x, panner.fieldWidthMetres()) ||
                isOutside(at.y, at.y, panner.fieldHeightMetres())) &&
               gainAt(at, panner, any) < inaudible;
    });
}

} // namespace

std::string outputReason(const ContactCounts& made, const OutputFacts& output) {
    const std::string trouble = output.trouble.empty() ? "" : " (" + std::string(output.trouble) + ")";
    if (output.isMissing) return "No device plays the events" + trouble + ": open one, or connect it again.";
    if (output.isSilent)
        return "Silence is held" +
               (output.silentBy.empty() ? std::string{} : " by " + std::string(output.silentBy)) +
               ": end it where it was asked for.";
    if (output.levelGain <= 0.0) return "The level of the output is 0: set it to 1, or to -12 dB.";
    if (output.levelGain < 1.01 * inaudible)
        return "The level of the output is " + threeDigits(toDecibels(output.levelGain)) +
               " dB, which nobody feels: raise it, to -12 dB at first.";
    if (output.dropped > 0)
        return counted(output.dropped, "event") +
               " found the renderer's queue full: pull samples all the time, or send fewer events.";
    if (output.rejected > 0)
        return counted(output.rejected, "event") +
               " cannot be played: frequency_hz must be below half the sample rate.";
    if (output.panner != nullptr)
        if (std::string why = placeReason(made, output); !why.empty()) return why;
    if (output.late > 0)
        return counted(output.late, "event") +
               " came late and were played at once: send them earlier, or raise the latency (longest_gap_s).";
    if (output.withoutPart > 0)
        return counted(output.withoutPart, "event") +
               " belong to a part of the body that no actuator is on, and are felt by their place on all: "
               "give the layout's actuators that part, or the body another.";
    if (output.levelGain < 0.03)
        return "The level of the output is low, " + threeDigits(toDecibels(output.levelGain)) +
               " dB: raise it.";
    if (output.panner != nullptr && isPartlyOutside(made, *output.panner))
        return fieldWords(made, *output.panner);
    return output.trouble.empty() ? "" : "The device reports: " + std::string(output.trouble) + ".";
}

} // namespace physvib
