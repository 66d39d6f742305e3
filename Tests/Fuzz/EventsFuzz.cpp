// SPDX-License-Identifier: MIT
// Fuzz target of the event list reader.
#include "Fuzzing.h"
#include "Scene/EventsCsv.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readEventsCsv(text, "f"); };
    const auto write = [](const EventList& list) { return eventsCsv(list.events, list.field, {"0", {}}); };
    const auto events = read(fuzz::asText(data, size));
    if (!events) {
        fuzz::demandClearRefusal(events, events.value.events.empty());
        return 0;
    }
    for (const CollisionEvent& event : events.value.events) fuzz::demand(isPlayable(event), "not playable");
    fuzz::demandRoundTrip(write(events.value), read, write);
    return 0;
}
