// SPDX-License-Identifier: MIT
// The columns of an event list (CSV): name, event field and valid cells of each, and functions that read and
// write one cell. Tables with optional columns omit those that none of their events needs.
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

/// A real number from `min` (or, with isMinExcluded, above it) to `max`.
struct NumberColumn {
    double& (*field)(CollisionEvent&);
    double min = std::numeric_limits<double>::lowest();
    double max = std::numeric_limits<double>::max();
    bool isMinExcluded = false;
};

/// The number of a fixture in the scene.
struct IntegerColumn {
    std::int32_t& (*field)(CollisionEvent&);
};

/// The cause of an event as a word. Optional: without it all events are hits.
struct KindColumn {
    ContactKind& (*field)(CollisionEvent&);
};

/// The name of the sound. Optional: without it events have no named sound.
struct MaterialColumn {
    SoundNumber& (*field)(CollisionEvent&);
};

/// The place across the plane, in m. Optional: 0 without it. Read as a NumberColumn.
struct DepthColumn : NumberColumn {};

/// The name of the part of the user's body that feels the event. Optional: without it all actuators play it.
struct PartColumn {
    PartNumber& (*field)(CollisionEvent&);
};
inline constexpr std::array<std::string_view, 3> contactKindNames{"hit", "roll", "slide"};

struct EventColumn {
    std::string_view name;
    std::variant<SecondsColumn, NumberColumn, IntegerColumn, KindColumn, MaterialColumn, DepthColumn,
                 PartColumn>
        cell;
};

template <auto Member>
auto& eventField(CollisionEvent& event) {
    return event.*Member;
}
template <auto Member>
auto& sourceField(CollisionEvent& event) {
    return event.source.*Member;
}

/// All columns in writing order, with the bounds of isPlayable(). impulse_ns is in newton seconds.
inline constexpr std::array<EventColumn, 15> eventColumns{{
    {"time_s", SecondsColumn{eventField<&CollisionEvent::timeNs>}},
    {"frequency_hz",
     NumberColumn{eventField<&CollisionEvent::frequencyHz>, 0.0, limits::maxFrequencyHz, true}},
    {"decay_per_s",
     NumberColumn{eventField<&CollisionEvent::decayPerSecond>, 0.0, limits::maxDecayPerSecond}},
    {"amplitude",
     NumberColumn{eventField<&CollisionEvent::amplitude>, -limits::maxAmplitude, limits::maxAmplitude}},
    {"x_m", NumberColumn{eventField<&CollisionEvent::x>}},
    {"y_m", NumberColumn{eventField<&CollisionEvent::y>}},
    {"duration_s", SecondsColumn{eventField<&CollisionEvent::durationNs>}},
    {"fixture", IntegerColumn{sourceField<&CollisionSource::fixture>}},
    {"other", IntegerColumn{sourceField<&CollisionSource::other>}},
    {"impulse_ns", NumberColumn{sourceField<&CollisionSource::impulseNewtonSeconds>}},
    {"mass_kg", NumberColumn{sourceField<&CollisionSource::massKg>, 0.0}},
    {"kind", KindColumn{sourceField<&CollisionSource::kind>}},
    {"material", MaterialColumn{eventField<&CollisionEvent::sound>}},
    {"z_m", DepthColumn{{eventField<&CollisionEvent::z>}}},
    {"part", PartColumn{sourceField<&CollisionSource::part>}},
}};

/// Columns up to y_m are required; the others have defaults.
inline constexpr std::size_t requiredEventColumns = 6;

/// Error text for an event whose frequency isTooSlow() refuses. Any thread.
inline std::string tooSlowError(const CollisionEvent& event) {
    return "expected at least " + numberText(limits::slowestToneHz) + " Hz, or a decay of at least " +
           numberText(limits::slowDecayPerSecond) + " per second, found " + numberText(event.frequencyHz) +
           " Hz";
}

/// Stores a valid cell in the event and returns empty; else returns what was expected.
inline std::string readCell(const SecondsColumn& column, std::string_view cell, CollisionEvent& event) {
    const auto nanoseconds = parseSeconds(cell);
    if (!nanoseconds) return "seconds from 0 to " + std::to_string(limits::maxTimeNs / 1'000'000'000);
    column.field(event) = *nanoseconds;
    return {};
}

inline std::string readCell(const NumberColumn& column, std::string_view cell, CollisionEvent& event) {
    const auto number = parseNumber<double>(cell);
    if (!number) return "a number";
    if (*number < column.min || (column.isMinExcluded && *number == column.min))
        return (column.isMinExcluded ? "a number > " : "a number >= ") + plainNumber(column.min);
    if (*number > column.max) return "a number <= " + plainNumber(column.max);
    column.field(event) = *number;
    return {};
}

inline std::string readCell(const IntegerColumn& column, std::string_view cell, CollisionEvent& event) {
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
    column.field(event) = toSoundNumber(cell);
    return {};
}
inline std::string readCell(const PartColumn& column, std::string_view cell, CollisionEvent& event) {
    column.field(event) = toPartNumber(cell);
    return {};
}

/// Appends the event's cell of that column to `out`.
inline void writeCell(const auto& column, CollisionEvent& event, const SoundNames& names, std::string& out) {
    using Column = std::decay_t<decltype(column)>;
    const auto& value = column.field(event);
    if constexpr (std::is_same_v<Column, SecondsColumn>)
        appendSeconds(out, value);
    else if constexpr (std::is_same_v<Column, KindColumn>)
        out += contactKindNames[static_cast<std::size_t>(value)];
    else if constexpr (std::is_same_v<Column, MaterialColumn>)
        out += names.nameOf(value);
    else if constexpr (std::is_same_v<Column, PartColumn>)
        out += names.parts.nameOf(value);
    else
        appendNumber(out, value);
}

} // namespace physvib
