// SPDX-License-Identifier: MIT
// Event lists as CSV: collisions written by one session and read by another, to the bit.
#pragma once
#include "Core/CollisionEvent.h"
#include "Io/Provenance.h"
#include "Io/Result.h"
#include "Scene/FieldSize.h"
#include "Scene/SceneFileLimits.h"
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace physvib {

struct EventList {
    std::vector<CollisionEvent> events;
    FieldSize field; ///< as the list says it; not known: it does not
    bool operator==(const EventList&) const = default;
};

/// The events of `text`, every one playable and none before the one above it; or, of the first thing that is
/// wrong, one line `name:17: column decay_per_s: expected a number >= 0, found "-3"`. Also wrong: no event,
/// or more than `maxRows`. The header line names the columns, in any order; those after y_m may be missing.
/// Cells hold plain numbers (no quotes; spaces around them are fine), lines end in \n or \r\n. Comments (#)
/// and blank lines may stand before the header, blank lines also at the end. A comment that has a word
/// `field_m=W,H` says the field. Any thread.
Result<EventList> readEventsCsv(std::string_view text, std::string_view name,
                                std::size_t maxRows = limits::maxEventRows);

/// The same of a file, of at most limits::maxEventsFileBytes and lines of a million bytes. M only.
Result<EventList> loadEventsCsv(const std::filesystem::path& path);

/// Comment and header line, and the line of one event: what eventsCsv puts together. `field`: said, if it is
/// known. `hasKinds`: with the column `kind`, which a list of hits alone does not need. Any thread.
std::string eventsCsvHead(Provenance provenance, FieldSize field, bool hasKinds);
void appendEventRow(std::string& text, CollisionEvent event, bool hasKinds);

/// The events with every column (`kind` if there is anything but hits); readEventsCsv gives them back bit for
/// bit if they are playable and in time order, and refuses them otherwise. Any thread.
std::string eventsCsv(std::span<const CollisionEvent> events, FieldSize field, const Provenance& provenance);

} // namespace physvib
