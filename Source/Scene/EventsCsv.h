// SPDX-License-Identifier: MIT
// Reads and writes event lists as CSV, which preserve events to the bit.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Scene/FieldSize.h"
#include "Scene/PartNames.h"
#include "Scene/SceneLimits.h"
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct EventList {
    std::vector<CollisionEvent> events;
    FieldSize field;  ///< as stated in the list; unknown otherwise
    SoundNames names; ///< of the materials and parts in the list
    bool operator==(const EventList&) const = default;
};

/// The events of `text`, all playable and in time order; or, for the first error, one line `name:17: column
/// decay_per_s: expected a number >= 0, found "-3"`. No event, or more than `maxRows`, is an error too. The
/// header line names the columns, in any order; those after y_m may be missing. Cells are plain numbers (no
/// quotes; spaces around them are allowed), lines end in LF or CR LF. Comments (#) and blank lines may
/// precede the header, blank lines may also end the file. A word `field_m=W,H` in a comment sets the field.
/// Any thread.
Result<EventList> readEventsCsv(std::string_view text, std::string_view name,
                                std::size_t maxRows = limits::maxEventRows);

/// Reads a file of at most limits::maxEventsFileBytes, with lines of at most 1 MB. Message thread only.
Result<EventList> loadEventsCsv(const std::filesystem::path& path);

/// Which optional columns a list has (see EventColumns.h).
struct OptionalColumns {
    bool kinds = false, materials = false, depths = false, parts = false;
};

inline constexpr OptionalColumns everyColumn{true, true, true, true}; ///< for events that are not known yet

/// The first two lines of a list: provenance comment (with `field` if known) and header. Any thread.
std::string eventsCsvHead(Provenance provenance, FieldSize field, OptionalColumns columns);
void appendEventRow(std::string& text, CollisionEvent event, OptionalColumns columns,
                    const SoundNames& names);

/// A complete list of the events with the columns that they need. If they are playable and in time order,
/// readEventsCsv restores them bit for bit; else it refuses the list. Any thread.
std::string eventsCsv(std::span<const CollisionEvent> events, FieldSize field, const Provenance& provenance,
                      const SoundNames& names = {});

} // namespace physvib
