// SPDX-License-Identifier: MIT
// Fuzz target of the session reader.
#include "Fuzzing.h"
#include "Live/Documents/SessionFile.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace physvib;
    const auto read = [](std::string_view text) { return readSession(text, "f"); };
    const auto session = read(fuzz::asText(data, size));
    if (!session) {
        fuzz::demandClearRefusal(session, session.value.log.takes.empty());
        return 0;
    }
    fuzz::demand(isValid(session.value.panner.layout()), "not valid");
    fuzz::demandRoundTrip(sessionJson(session.value), read,
                          [](const SavedSession& again) { return sessionJson(again); });
    return 0;
}
