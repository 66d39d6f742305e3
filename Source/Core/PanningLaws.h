// SPDX-License-Identifier: MIT
// Table of the panning laws: name and gain function of each. Files, options, messages, bindings and the
// plug-in's parameter read it; a test compares it with Docs/panning.md.
#pragma once
#include "Core/PortableMath.h"
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace physvib {
/// How a gain falls with the distance ratio u = d/D from an actuator, u in [0, 1]. Append new ones at the
/// end: C programs use the numbers.
enum class PanningLaw {
    linear,     ///< 1 - u (Eq. 4.2)
    log,        ///< 1 - log2(1 + u): reconstruction of Eq. 4.3, falls faster than linear
    logOuter,   ///< log2(2 - u): the other reconstruction, above linear
    energy,     ///< sqrt(1 - u): squares sum to one wherever linear gains do
    neighbours, ///< energy, shared by the actuators around the place: two of a row or belt, four of a grid
    automatic,  ///< the default: PhantomPanner replaces it by a law that suits the layout's shape
    distance,   ///< energy, shared by all actuators of any layout by their distance in space
    /// energy, shared by the corners of the triangle in space that the place lies in; flat: `neighbours`
    triangles,
};

/// One panning law.
struct PanningLawDescription {
    PanningLaw law;                    ///< its number, which is its index in the table
    std::string_view name;             ///< used in files, options and states: never changes
    double (*gain)(double u) noexcept; ///< at distance ratio u: 1 at u = 0, 0 at u = 1
};

/// All panning laws, indexed by PanningLaw.
inline constexpr auto panningLaws = std::to_array<PanningLawDescription>({
    {PanningLaw::linear, "linear", [](double u) noexcept { return 1.0 - u; }},
    {PanningLaw::log, "log", [](double u) noexcept { return 1.0 - portable::log2(1.0 + u); }},
    {PanningLaw::logOuter, "log-outer", [](double u) noexcept { return portable::log2(2.0 - u); }},
    {PanningLaw::energy, "energy", [](double u) noexcept { return std::sqrt(1.0 - u); }},
    {PanningLaw::neighbours, "neighbours", [](double u) noexcept { return std::sqrt(1.0 - u); }},
    {PanningLaw::automatic, "auto", [](double u) noexcept { return 1.0 - u; }}, // replaced before use
    {PanningLaw::distance, "distance", [](double u) noexcept { return std::sqrt(1.0 - u); }},
    {PanningLaw::triangles, "triangles", [](double u) noexcept { return std::sqrt(1.0 - u); }},
});

/// The law's table entry. Any thread.
constexpr const PanningLawDescription& describe(PanningLaw law) noexcept {
    return panningLaws[static_cast<std::size_t>(law)];
}

/// The law's name in files and options. Any thread.
constexpr std::string_view nameOf(PanningLaw law) noexcept { return describe(law).name; }

/// Perceived place, 0 to 1, of an impact that is panned to `share` of the way between two actuators: the
/// centroid of intensity. Any thread.
inline double centroidOf(PanningLaw law, double share) noexcept {
    const double nearGain = describe(law).gain(share), farGain = describe(law).gain(1.0 - share);
    return farGain * farGain / (nearGain * nearGain + farGain * farGain);
}

/// Names of the laws, in table order.
inline constexpr auto panningLawNames = [] {
    std::array<std::string_view, panningLaws.size()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = panningLaws[i].name;
    return names;
}();

static_assert(
    [] {
        for (std::size_t i = 0; i < panningLaws.size(); ++i)
            if (static_cast<std::size_t>(panningLaws[i].law) != i) return false;
        return true;
    }(),
    "each law at the place of its number");

/// The law of that name; false if there is none. Any thread.
constexpr bool panningLawNamed(std::string_view name, PanningLaw& law) noexcept {
    for (const auto& entry : panningLaws) {
        if (entry.name != name) continue;
        law = entry.law;
        return true;
    }
    return false;
}

/// How an event is distributed over the actuators, if not by the layout's panning law. Between `layout` and
/// `equal` lie unnamed values, one per panning law with exponent 1: spreadBy() returns them.
enum class Spread : std::uint8_t {
    layout,                         ///< by the panner's law and exponent, as all impacts
    equal = 1 + panningLaws.size(), ///< energy law, scaled so that the squares always sum to one: perceived
                                    ///< strength does not depend on the place
    nearest                         ///< the nearest actuator only
};

/// The spread by that law, exponent 1. Any thread.
constexpr Spread spreadBy(PanningLaw law) noexcept {
    return static_cast<Spread>(1 + static_cast<std::size_t>(law));
}

/// Recommended for grains between two actuators and on four corners: the centroid of their intensity is at
/// the contact (Docs/panning.md). Elsewhere: PhantomPanner::travelSpread.
inline constexpr Spread grainSpread = spreadBy(PanningLaw::energy);

/// Names, indexed by Spread.
inline constexpr auto spreadNames = [] {
    std::array<std::string_view, panningLaws.size() + 3> names{"layout"};
    for (const auto& entry : panningLaws) names[static_cast<std::size_t>(spreadBy(entry.law))] = entry.name;
    names[static_cast<std::size_t>(Spread::equal)] = "equal";
    names[static_cast<std::size_t>(Spread::nearest)] = "alone";
    return names;
}();

/// The name in files and messages. Any thread.
constexpr std::string_view nameOf(Spread spread) noexcept {
    return spreadNames[static_cast<std::size_t>(spread)];
}

} // namespace physvib
