// SPDX-License-Identifier: MIT
// Size of the field that x and y of events refer to: its text format, a warning about events outside, and why
// a render would be silent, which programs must report.
#pragma once
#include "Core/CollisionEvent.h"
#include "Core/PhantomPanner.h"
#include "Io/Text/NumberText.h"
#include "Scene/SceneLimits.h"
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace physvib {

/// Width and height, in metres. 0: not known.
struct FieldSize {
    double widthMetres = 0.0, heightMetres = 0.0;
    bool isKnown() const noexcept { return widthMetres > 0.0 && heightMetres > 0.0; }
    bool operator==(const FieldSize&) const = default;
};

inline constexpr std::string_view expectedFieldText = "expected W,H in metres (0.001 to 1e6), found ";

inline bool isValidField(FieldSize field) noexcept {
    const auto isLength = [](double metres) {
        return metres >= limits::minExtentMetres && metres <= limits::maxExtentMetres;
    };
    return isLength(field.widthMetres) && isLength(field.heightMetres);
}

/// Parses `6.4,3.6`; nullopt for anything else. Any thread.
std::optional<FieldSize> parseField(std::string_view word);

/// Text that parseField reads. Any thread.
inline std::string fieldText(FieldSize field) {
    return numberText(field.widthMetres) + ',' + numberText(field.heightMetres);
}

inline FieldSize extentOf(const ActuatorLayout& layout) noexcept {
    return {layout.extentWidthMetres, layout.extentHeightMetres};
}
inline FieldSize fieldOf(const PhantomPanner& panner) noexcept {
    return {panner.fieldWidthMetres(), panner.fieldHeightMetres()};
}

/// A warning such as `67 of 67 hits lie outside the field of 0.12 x 0.06 m (see --field)`, or empty.
/// `isGuessed`: the list has no field, so the layout's extent is used. Up to a twentieth beyond the field
/// counts as inside, because bodies sink into walls at the edge. Any thread.
inline std::string outsideFieldWarning(std::span<const CollisionEvent> events, FieldSize field,
                                       bool isGuessed) {
    const auto isOutside = [](double position, double length) {
        return !(std::abs(position - 0.5 * length) <= 0.55 * length);
    };
    const auto outside = std::ranges::count_if(events, [&](const CollisionEvent& e) {
        return isOutside(e.x, field.widthMetres) || isOutside(e.y, field.heightMetres);
    });
    if (outside == 0) return {};
    return std::to_string(outside) + " of " + std::to_string(events.size()) +
           " hits lie outside the field of " + numberText(field.widthMetres) + " x " +
           numberText(field.heightMetres) + " m" +
           (isGuessed ? ", the layout's, as the list says none (see --field)" : " (see --field)");
}

/// Why no event before `endNs` reaches any actuator with more than `minLevel` (a share of full scale); empty
/// if one does. Any thread.
inline std::string silenceReason(std::span<const CollisionEvent> events, const PhantomPanner& panner,
                                 bool isGuessed, std::int64_t endNs, double minLevel = 0.0) {
    PhantomPanner::Gains gains{};
    bool hasEvent = false;
    double maxAmplitude = 0.0, maxLevel = 0.0; // highest amplitude of events, highest level at an actuator
    for (const CollisionEvent& e : events) {
        if (e.timeNs >= endNs) continue;
        hasEvent = true;
        maxAmplitude = std::max(maxAmplitude, std::abs(e.amplitude));
        panner.gainsAt(e, gains);
        for (std::size_t j = 0; j < static_cast<std::size_t>(panner.channels()); ++j)
            maxLevel = std::max(maxLevel, std::abs(e.amplitude * gains[j]));
    }
    if (maxLevel > minLevel) return {};
    if (events.empty()) return "there are no hits";
    if (!hasEvent) return "all hits begin after the end";
    if (!(maxAmplitude > minLevel))
        return "the strongest hit is " + fixedNumber(maxAmplitude, 6) + " of full scale";
    const std::string outside = outsideFieldWarning(events, fieldOf(panner), isGuessed);
    return outside.empty() ? "all hits lie where they reach no actuator" : outside;
}

} // namespace physvib
