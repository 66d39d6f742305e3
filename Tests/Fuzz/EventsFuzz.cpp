// SPDX-License-Identifier: MIT
// Fuzz target of the event list reader.
#include "Fuzzing.h"
#include "Scene/EventsCsv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto list = fuzz::tried(
        data, size, [](auto text, auto name) { return readEventsCsv(text, name); },
        [](const EventList& all) {
            return eventsCsv(all.events, all.field, {"0", {}});
        },
        [](const EventList& all) { return all.events.empty(); });
    if (!list) return 0;
    for (const CollisionEvent& event : list->events) fuzz::demand(isPlayable(event), "not playable");
    return 0;
}
