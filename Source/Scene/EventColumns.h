// SPDX-License-Identifier: MIT
// The columns of an event list, for reading and writing: name, event field, valid cells.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Text/DecimalSeconds.h"
#include "Io/Text/NumberText.h"
#include "Scene/PartNames.h"
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>

namespace physvib {

/// A time, 0 to limits::maxTimeNs, written in seconds.
struct SecondsColumn {
    std::int64_t& (*field)(CollisionEvent&);
};

/// A real number from `least` (or, with aboveLeast, above it) to `most`.
struct NumberColumn {
    double& (*field)(CollisionEvent&);
    double least = std::numeric_limits<double>::lowest();
    double most = std::numeric_limits<double>::max();
    bool aboveLeast = false;
};

/// The number of a fixture.
struct WholeColumn {
    std::int32_t& (*field)(CollisionEvent&);
};

/// The cause of an event; lists with impacts alone have no such column, like all older lists.
struct KindColumn {
    ContactKind& (*field)(CollisionEvent&);
};

/// The name of the sound; lists whose events have none have no such column.
struct MaterialColumn {
    SoundNumber& (*field)(CollisionEvent&);
};

/// The place across the plane; lists of a plane have no such column.
struct DepthColumn : NumberColumn {};

/// The name of the part of a body on which it is felt; lists without any have no such column.
struct PartColumn {
    PartNumber& (*field)(CollisionEvent&);
};
inline constexpr std::array<std::string_view, 3> contactKindNames{"hit", "roll", "slide"};

struct EventColumn {
    std::string_view name;
    std::variant<SecondsColumn, NumberColumn, WholeColumn, KindColumn, MaterialColumn, DepthColumn,
                 PartColumn>
        cell;
};

template <auto Member>
auto& of(CollisionEvent& event) {
    return event.*Member;
}
template <auto Member>
auto& ofSource(CollisionEvent& event) {
    return event.source.*Member;
}

/// In writing order. The bounds are those of isPlayable; a mass is not negative.
inline constexpr std::array<EventColumn, 15> eventColumns{{
    {"time_s", SecondsColumn{of<&CollisionEvent::timeNs>}},
    {"frequency_hz", NumberColumn{of<&CollisionEvent::frequencyHz>, 0.0, limits::maxFrequencyHz, true}},
    {"decay_per_s", NumberColumn{of<&CollisionEvent::decayPerSecond>, 0.0, limits::maxDecayPerSecond}},
    {"amplitude", NumberColumn{of<&CollisionEvent::amplitude>, -limits::maxAmplitude, limits::maxAmplitude}},
    {"x_m", NumberColumn{of<&CollisionEvent::x>}},
    {"y_m", NumberColumn{of<&CollisionEvent::y>}},
    {"duration_s", SecondsColumn{of<&CollisionEvent::durationNs>}},
    {"fixture", WholeColumn{ofSource<&CollisionSource::fixture>}},
    {"other", WholeColumn{ofSource<&CollisionSource::other>}},
    {"impulse_ns", NumberColumn{ofSource<&CollisionSource::impulseNewtonSeconds>}},
    {"mass_kg", NumberColumn{ofSource<&CollisionSource::massKg>, 0.0}},
    {"kind", KindColumn{ofSource<&CollisionSource::kind>}},
    {"material", MaterialColumn{of<&CollisionEvent::sound>}},
    {"z_m", DepthColumn{{of<&CollisionEvent::z>}}},
    {"part", PartColumn{ofSource<&CollisionSource::part>}},
}};

/// Columns up to y_m are required; the others have defaults.
inline constexpr std::size_t requiredEventColumns = 6;

/// The error of an event's frequency if isTooSlow. Any thread.
inline std::string tooSlowFault(const CollisionEvent& event) {
    return "expected at least " + numberText(limits::slowestToneHz) + " Hz, or a decay of at least " +
           numberText(limits::slowDecayPerSecond) + " per second, found " + numberText(event.frequencyHz) +
           " Hz";
}

/// Returns the expectation, or empty if the cell was valid and is stored.
inline std::string readCell(const SecondsColumn& column, std::string_view cell, CollisionEvent& event) {
    const auto nanoseconds = parseSeconds(cell);
    if (!nanoseconds) return "seconds from 0 to " + std::to_string(limits::maxTimeNs / 1'000'000'000);
    column.field(event) = *nanoseconds;
    return {};
}

inline std::string readCell(const NumberColumn& column, std::string_view cell, CollisionEvent& event) {
    const auto number = parseNumber<double>(cell);
    if (!number) return "a number";
    if (*number < column.least || (column.aboveLeast && *number == column.least))
        return (column.aboveLeast ? "a number > " : "a number >= ") + plainNumber(column.least);
    if (*number > column.most) return "a number <= " + plainNumber(column.most);
    column.field(event) = *number;
    return {};
}

inline std::string readCell(const WholeColumn& column, std::string_view cell, CollisionEvent& event) {
    const auto number = parseNumber<std::int32_t>(cell);
    if (!number) return "a whole number";
    column.field(event) = *number;
    return {};
}

inline std::string readCell(const KindColumn& column, std::string_view cell, CollisionEvent& event) {
    const auto found = std::ranges::find(contactKindNames, cell);
    if (found == contactKindNames.end()) return "hit, roll or slide";
    column.field(event) = static_cast<ContactKind>(found - contactKindNames.begin());
    return {};
}

inline std::string readCell(const MaterialColumn& column, std::string_view cell, CollisionEvent& event) {
    column.field(event) = soundNamed(cell);
    return {};
}
inline std::string readCell(const PartColumn& column, std::string_view cell, CollisionEvent& event) {
    column.field(event) = partOf(cell);
    return {};
}

/// Appends the event's cell.
inline void writeCell(const auto& column, CollisionEvent& event, const SoundNames& names, std::string& out) {
    using Column = std::decay_t<decltype(column)>;
    const auto& value = column.field(event);
    if constexpr (std::is_same_v<Column, SecondsColumn>)
        appendSeconds(out, value);
    else if constexpr (std::is_same_v<Column, KindColumn>)
        out += contactKindNames[static_cast<std::size_t>(value)];
    else if constexpr (std::is_same_v<Column, MaterialColumn>)
        out += names.of(value);
    else if constexpr (std::is_same_v<Column, PartColumn>)
        out += names.parts.of(value);
    else
        appendNumber(out, value);
}

} // namespace physvib
